use light_bounds::{Gloss, LightSampleContext};
use light_math::glam::Vec3;

use crate::Rng;

/// A receiver of any kind in and around the box from `low` to `high`.
pub(super) fn receiver(rng: &mut Rng, low: Vec3, high: Vec3) -> LightSampleContext {
    let size = (high - low).max(Vec3::splat(1e-3));
    let p = low - size * 0.25 + size * 1.5 * rng.vec3();
    let n = rng.direction();
    let ns = (n + 0.3 * rng.direction()).normalize_or(n);
    match rng.below(8) {
        0 => LightSampleContext::medium(p),
        1 => {
            let along = rng.direction() * size.max_element() * rng.log_range(1e-3, 10.0);
            LightSampleContext::segment(p, along)
        }
        2 => LightSampleContext::two_sided(p, n, ns),
        3 => LightSampleContext::surface(p, n, ns).with_gloss(Gloss {
            wo: rng.direction(),
            alpha: rng.log_range(0.01, 1.0),
            diffuse: rng.f32(),
        }),
        4 => LightSampleContext::surface(p, n, ns),
        5 => LightSampleContext::surface(p, Vec3::Z, Vec3::Z),
        _ => LightSampleContext::surface(p, n, n),
    }
}
