//! How noisy the night scene with its 20,000 lights is after equal time, for each way to choose
//! lights and each number of choices at the first vertex; direct light alone, and full paths.
//!
//! Two pictures of other seeds tell the noise without a reference: half their squared difference is
//! what relMSE would be against a perfect one, times the time that one of them took. Pixels that
//! show a light are left out, as in the demo. Time is that of the threads where the system tells it
//! (Linux), so that other work on the machine counts little; wall-clock time elsewhere.

use core::num::NonZeroU32;

use light_render::bench::{PictureBench, TimedPicture};
use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{AnyLightSampler, AnyLightSamplerError, SamplerKind, View, World};
use light_scene::BuiltinScene;

const SIZE: (u32, u32) = (240, 135);
const SPP: u32 = 8;
const REFERENCE_SPP: u32 = 32;

/// Keeps dark pixels from ruling the relative error.
const FLOOR: f64 = 0.01;

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

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let scene = BuiltinScene::Night.load();
    let view = View::new(&scene.camera_or_default(), SIZE.0, SIZE.1)?;
    let bench = PictureBench::new(World::new(scene)?, view)?;
    for (name, max_depth) in [("direct light", 2), ("full paths", 6)] {
        println!("{name:<14} choices   relMSE at {SPP} spp   seconds   relMSE x seconds");
        let picture =
            |kind, choices, spp, seed| picture(&bench, kind, [choices, max_depth], spp, seed);
        let reference = picture(SamplerKind::Bvh, 4, REFERENCE_SPP, 77)?;
        let relative = bench.error(&reference.pixels, FLOOR);
        for (kind, choices) in ROWS {
            let a = picture(kind, choices, SPP, 1)?;
            let b = picture(kind, choices, SPP, 2)?;
            let error = relative.of_pair(&a.pixels, &b.pixels);
            let time = 0.5 * (a.seconds + b.seconds);
            println!(
                "{:<14} {choices:>7} {error:>18.4} {time:>9.2} {:>18.4}",
                kind.name(),
                error * time
            );
        }
    }
    Ok(())
}

/// A picture with so many choices at the first vertex, of paths of at most so many segments.
fn picture(
    bench: &PictureBench,
    kind: SamplerKind,
    [choices, max_depth]: [u32; 2],
    spp: u32,
    seed: u32,
) -> Result<TimedPicture, AnyLightSamplerError> {
    let sampler = AnyLightSampler::new(kind, bench.world().lights())?;
    let path = PathSettings {
        max_depth,
        estimator: Estimator::Mis,
        light_samples: NonZeroU32::new(choices).unwrap_or(NonZeroU32::MIN),
        integrator: Integrator::Path,
    };
    Ok(bench.picture(&sampler, path, spp, seed))
}
