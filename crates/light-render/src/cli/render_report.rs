use core::time::Duration;
use std::path::Path;

use lights::glam::DVec3;
use serde_json::{Value, json};

use crate::{Film, Rendering, SamplerKind, World};

use super::visibility::VisibilityCosts;

/// What `lights render --json` says about a picture.
pub(super) struct RenderReport<'a> {
    pub(super) scene: &'a Path,
    pub(super) sampler: SamplerKind,
    pub(super) world: &'a World,
    pub(super) rendering: &'a Rendering,
    /// Milliseconds to build the sampler.
    pub(super) build_ms: f64,
    /// Mean time of choosing and sampling a light; `None` where the camera sees nothing.
    pub(super) sample_time: Option<Duration>,
    pub(super) visibility: &'a VisibilityCosts,
}

impl RenderReport<'_> {
    /// One line of JSON.
    pub(super) fn json(&self) -> Value {
        let rendering = self.rendering;
        json!({
            "scene": self.scene.display().to_string(),
            "sampler": self.sampler.name(),
            "seconds": (self.visibility.time + rendering.elapsed).as_secs_f64(),
            "spp": rendering.film.samples(),
            "lights": self.world.lights().len(),
            "triangles": self.world.triangle_count(),
            "tree_build_ms": self.build_ms,
            "ns_per_light_sample": self.sample_time.map(|time| time.as_secs_f64() * 1e9),
            "rays": rendering.rays,
            "mean": mean(&rendering.film).to_array(),
            "visibility_seconds": self.visibility.time.as_secs_f64(),
            "visibility_bytes": self.visibility.bytes,
        })
    }
}

/// The mean of all pixels.
fn mean(film: &Film) -> DVec3 {
    let pixels = film.develop();
    let sum: DVec3 = pixels.iter().map(|pixel| pixel.as_dvec3()).sum();
    sum / pixels.len().max(1) as f64
}
