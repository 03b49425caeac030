//! How noisy the night scene with its 20,000 lights is after equal time, for each way to choose
//! lights and each number of choices at the first vertex; direct light alone, and full paths.
//!
//! Two pictures of other seeds tell the noise without a reference: half their squared difference is
//! what relMSE would be against a perfect one, times the time that one of them took. Pixels that
//! show a light are left out, as in the demo. Time is that of the threads where the system tells it
//! (Linux), so that other work on the machine counts little; wall-clock time elsewhere.

use core::num::NonZeroU32;
use std::fs;
use std::time::Instant;

use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{AnyLightSampler, RenderSettings, SamplerKind, View, World, render};
use light_scene::BuiltinScene;
use light_scene::glam::{DVec3, Vec3};

const SIZE: (u32, u32) = (240, 135);
const SPP: u32 = 8;
const REFERENCE_SPP: u32 = 32;

/// What is compared: first the ones that the default is measured against.
const ROWS: [(SamplerKind, u32); 10] = [
    (SamplerKind::Uniform, 4),
    (SamplerKind::Power, 4),
    (SamplerKind::BvhReference, 1),
    (SamplerKind::BvhReference, 4),
    (SamplerKind::BvhReference, 8),
    (SamplerKind::BvhReference, 16),
    (SamplerKind::Bvh, 1),
    (SamplerKind::Bvh, 2),
    (SamplerKind::Bvh, 4),
    (SamplerKind::Bvh, 16),
];

struct Stage {
    world: World,
    view: View,
}

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let scene = BuiltinScene::Night.load();
    let view = View::new(&scene.camera_or_default(), SIZE.0, SIZE.1)?;
    let world = World::new(scene)?;
    let stage = Stage { world, view };
    let measured = stage.sees_no_light()?;
    for (name, max_depth) in [("direct light", 2), ("full paths", 6)] {
        println!("{name:<14} choices   relMSE at {SPP} spp   seconds   relMSE x seconds");
        let (reference, _) = stage.picture(SamplerKind::Bvh, 4, max_depth, REFERENCE_SPP, 77)?;
        for (kind, choices) in ROWS {
            let (a, time_a) = stage.picture(kind, choices, max_depth, SPP, 1)?;
            let (b, time_b) = stage.picture(kind, choices, max_depth, SPP, 2)?;
            let error = noise(&a, &b, &reference, &measured);
            let time = 0.5 * (time_a + time_b);
            println!(
                "{:<14} {choices:>7} {error:>18.4} {time:>9.2} {:>18.4}",
                kind.name(),
                error * time
            );
        }
    }
    Ok(())
}

impl Stage {
    /// A picture, and the seconds that it took.
    fn picture(
        &self,
        kind: SamplerKind,
        choices: u32,
        max_depth: u32,
        spp: u32,
        seed: u32,
    ) -> Result<(Vec<Vec3>, f64), Box<dyn core::error::Error>> {
        let sampler = AnyLightSampler::new(kind, self.world.lights())?;
        let settings = RenderSettings {
            samples: 0..spp,
            time_limit: None,
            seed,
            path: PathSettings {
                max_depth,
                estimator: Estimator::Mis,
                light_samples: NonZeroU32::new(choices).unwrap_or(NonZeroU32::MIN),
                integrator: Integrator::Path,
            },
        };
        let start = (Instant::now(), thread_seconds());
        let film = render(&self.world, &self.view, &sampler, &settings, |_| ()).film;
        let seconds = match (start.1, thread_seconds()) {
            (Some(before), Some(after)) => after - before,
            _ => start.0.elapsed().as_secs_f64(),
        };
        Ok((film.develop(), seconds))
    }

    /// Where neither a pixel nor one beside it shows a light.
    fn sees_no_light(&self) -> Result<Vec<bool>, Box<dyn core::error::Error>> {
        let (width, height) = SIZE;
        let (seen, _) = self.picture(SamplerKind::Uniform, 1, 1, 32, 1)?;
        let is_dark = |x: u32, y: u32| seen[(y * width + x) as usize] == Vec3::ZERO;
        let around = |i: u32, end: u32| i.saturating_sub(1)..(i + 2).min(end);
        let dark = |x, y| around(y, height).all(|v| around(x, width).all(|u| is_dark(u, v)));
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Ok(pixels.map(|(x, y)| dark(x, y)).collect())
    }
}

/// The relMSE that two pictures of the same kind have against a perfect one, over the pixels that
/// are measured.
fn noise(a: &[Vec3], b: &[Vec3], reference: &[Vec3], measured: &[bool]) -> f64 {
    let errors: Vec<f64> = (0..a.len())
        .filter(|&i| measured[i])
        .map(|i| {
            let [a, b, r] = [a[i], b[i], reference[i]].map(|x| x.as_dvec3());
            let half_squared = (a - b) * (a - b) * 0.5;
            (half_squared / (r * r + DVec3::splat(0.01))).element_sum() / 3.0
        })
        .collect();
    errors.iter().sum::<f64>() / errors.len() as f64
}

/// The seconds that all threads of this program have run, where the system tells them.
fn thread_seconds() -> Option<f64> {
    let mut nanoseconds = 0.0;
    for task in fs::read_dir("/proc/self/task").ok()? {
        let line = fs::read_to_string(task.ok()?.path().join("schedstat")).ok()?;
        nanoseconds += line.split_whitespace().next()?.parse::<f64>().ok()?;
    }
    Some(nanoseconds * 1e-9)
}
