//! A thousand lamps in fog: lights for the ray as a whole against the classic march, at equal time.
//! `cargo run --release -p light-render --example fog_lamps`

use core::num::NonZeroU32;

use light_render::integrator::{Estimator, Integrator, PathSettings, SingleScattering};
use light_render::{
    AnyLightSampler, Comparison, RenderSettings, Rendering, SamplerKind, View, World, render,
};
use light_scene::BuiltinScene;
use lights::glam::Vec3;
use lights::media::StepSize;

const WIDTH: u32 = 96;
const HEIGHT: u32 = 54;

/// One way to find the light that the fog scatters.
struct Method {
    name: &'static str,
    sampler: SamplerKind,
    scattering: SingleScattering,
    lights: u32,
    spp: u32,
}

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let scene = BuiltinScene::Fog.load();
    let view = View::new(&scene.camera_or_default(), WIDTH, HEIGHT)?;
    let world = World::new(scene)?;
    let picture =
        |method: &Method, seed| -> Result<(Vec<Vec3>, Rendering), Box<dyn core::error::Error>> {
            let settings = RenderSettings {
                samples: 0..method.spp,
                time_limit: None,
                seed,
                path: PathSettings {
                    max_depth: 2,
                    estimator: Estimator::Mis,
                    light_samples: NonZeroU32::new(method.lights).ok_or("no lights")?,
                    integrator: Integrator::SingleScattering(method.scattering),
                },
            };
            let sampler = AnyLightSampler::new(method.sampler, world.lights())?;
            let rendering = render(&world, &view, &sampler, &settings, |_| ());
            Ok((rendering.film.develop(), rendering))
        };

    let marched = |name, sampler, step, spp| -> Result<Method, Box<dyn core::error::Error>> {
        Ok(Method {
            name,
            sampler,
            scattering: SingleScattering::Classic(StepSize::new(step)?),
            lights: 16,
            spp,
        })
    };
    let asked = |name, lights, spp| Method {
        name,
        sampler: SamplerKind::Bvh,
        scattering: SingleScattering::NextEvent,
        lights,
        spp,
    };
    let (reference, taken) = picture(&asked("reference", 64, 192), 99)?;
    println!("reference: 192 spp in {:.0} s", taken.elapsed.as_secs_f64());
    println!(
        "{:<34} {:>4} {:>8} {:>10} {:>10} {:>9} {:>8}",
        "method", "spp", "s", "mean", "relMSE", "x s", "ratio"
    );
    let methods = [
        marched("march of 1 m, lamps by power", SamplerKind::Power, 1.0, 8)?,
        marched("march of 1 m, lamps alike", SamplerKind::Uniform, 1.0, 8)?,
        marched("march of 4 m, lamps by power", SamplerKind::Power, 4.0, 32)?,
        marched("march of 1 m, by the hierarchy", SamplerKind::Bvh, 1.0, 8)?,
        asked("4 lamps for the ray", 4, 32),
        asked("16 lamps for the ray", 16, 16),
        asked("64 lamps for the ray", 64, 4),
    ];
    let mut classic = None;
    for method in methods {
        let (image, rendering) = picture(&method, 1)?;
        let comparison = Comparison::new(&image, &reference).ok_or("two sizes")?;
        let seconds = rendering.elapsed.as_secs_f64();
        let cost = comparison.rel_mse * seconds;
        let classic = *classic.get_or_insert(cost);
        let mean = image.iter().map(|t| t.element_sum() / 3.0).sum::<f32>() / image.len() as f32;
        println!(
            "{:<34} {:>4} {seconds:>8.2} {mean:>10.4} {:>10.4} {cost:>9.4} {:>8.1}",
            method.name,
            method.spp,
            comparison.rel_mse,
            classic / cost
        );
    }
    Ok(())
}
