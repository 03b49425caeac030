//! A ray through fog among a thousand lamps: the classic march against asking for light, at equal
//! time. `cargo run --release -p light-media --example thousand_lamps`

use std::time::Instant;

use light_media::glam::Vec3;
use light_media::phase::HenyeyGreenstein;
use light_media::{
    Homogeneous, LatinHypercube, Phase, Ray, Region, Span, StepSize, Substance, Visibility,
    VolumeIntegrator,
};
use light_samplers::{BvhLightSampler, PowerLightSampler};
use light_sources::{
    IntensityAmount, LightDesc, LightSetBuilder, MediumInterface, PointLightDesc, Rgb, SceneSphere,
};

/// A street whose lamps nothing hides.
struct Open;

impl Visibility for Open {
    fn unoccluded(&self, _from: Vec3, _to: Vec3) -> bool {
        true
    }
}

const RAYS: u32 = 64;
const REPEATS: u32 = 128;

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 100.0)?);
    let places = LatinHypercube::new(1000, 1);
    for i in 0..1000 {
        let [x, y, z, power] = places.point_f32(i);
        lights.add(LightDesc::Point(PointLightDesc {
            position: Vec3::new(x * 40.0 - 20.0, y * 6.0, z * 40.0 - 20.0),
            emission: Vec3::ONE,
            amount: IntensityAmount::Radiometric(0.1 * 100.0f32.powf(power)),
            media: MediumInterface::default(),
        }))?;
    }
    let lights = lights.build();
    let fog = Homogeneous::<Rgb> {
        substance: Substance::new(Vec3::splat(0.005), Vec3::splat(0.05), Vec3::ZERO)?,
        phase: Phase::HenyeyGreenstein(HenyeyGreenstein::new(0.5)?),
        region: Region::UNBOUNDED,
    };
    let step = StepSize::new(1.0)?;
    let power = PowerLightSampler::new(&lights.powers())?;
    let tree = BvhLightSampler::new(&lights.extents())?;
    macro_rules! integrator {
        ($sampler:expr) => {
            VolumeIntegrator {
                medium: &fog,
                lights: &lights,
                sampler: $sampler,
                scene: &Open,
                wavelengths: &(),
                step,
                shadow_step: step,
            }
        };
    }
    let (classic, marched, asked) = (integrator!(&power), integrator!(&tree), integrator!(&tree));

    let next_u = |seed: u32| {
        let numbers = LatinHypercube::new(1 << 16, seed);
        let mut drawn = 0;
        move || {
            drawn += 1;
            numbers.point_f32::<1>(drawn)[0]
        }
    };
    // The truth: all lamps at many points of each ray.
    let truth: Vec<f64> = (0..RAYS)
        .map(|i| {
            let ray = ray(i);
            let estimates = (0..64).map(|k| {
                f64::from(
                    asked
                        .next_event(&ray, SPAN, 4096, k * RAYS + i, &mut next_u(k * RAYS + i))
                        .l
                        .x,
                )
            });
            estimates.sum::<f64>() / 64.0
        })
        .collect();

    println!(
        "{:<44} {:>9} {:>10} {:>14}",
        "method", "us a ray", "relMSE", "relMSE x time"
    );
    let report = |name: &str, estimate: &dyn Fn(&Ray, u32) -> f32| {
        let start = Instant::now();
        let mut error = 0.0;
        for repeat in 0..REPEATS {
            for (i, truth) in (0..RAYS).zip(&truth) {
                let difference = f64::from(estimate(&ray(i), 1 + repeat * RAYS + i)) - truth;
                error += (difference / truth).powi(2);
            }
        }
        let rays = f64::from(RAYS * REPEATS);
        let (us, error) = (start.elapsed().as_secs_f64() * 1e6 / rays, error / rays);
        println!("{name:<44} {us:>9.1} {error:>10.5} {:>14.3}", us * error);
        us * error
    };
    let by_power = report("march, lamps by power", &|ray, seed| {
        classic
            .single_scattering(ray, SPAN, seed, &mut next_u(seed))
            .l
            .x
    });
    let by_tree = report("march, lamps by the hierarchy", &|ray, seed| {
        marched
            .single_scattering(ray, SPAN, seed, &mut next_u(seed))
            .l
            .x
    });
    for samples in [4, 16, 64] {
        let ours = report(&format!("{samples} lamps asked for"), &|ray, seed| {
            asked
                .next_event(ray, SPAN, samples, seed, &mut next_u(seed))
                .l
                .x
        });
        println!(
            "    {:.1} times better than the march by power, {:.1} than the one by the hierarchy",
            by_power / ours,
            by_tree / ours
        );
    }
    Ok(())
}

const SPAN: Span = Span { t0: 0.0, t1: 40.0 };

/// Rays along the street, at the height of the lamps.
fn ray(i: u32) -> Ray {
    let [x, y, dx] = LatinHypercube::new(RAYS, 5).point_f32(i);
    Ray {
        o: Vec3::new(x * 20.0 - 10.0, 1.0 + 4.0 * y, -20.0),
        d: Vec3::new(0.4 * dx - 0.2, 0.0, 1.0).normalize(),
    }
}
