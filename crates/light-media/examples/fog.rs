//! Three lamps in fog behind a pillar, printed as characters:
//! `cargo run --release -p light-media --example fog`.
//!
//! All that the integrators ask of a scene is whether two points see each other.

use light_media::glam::Vec3;
use light_media::phase::HenyeyGreenstein;
use light_media::{
    Homogeneous, LatinHypercube, Phase, Ray, Region, Span, StepSize, Substance, Visibility,
    VolumeIntegrator,
};
use light_samplers::PowerLightSampler;
use light_sources::{
    IntensityAmount, LightDesc, LightSetBuilder, MediumInterface, PointLightDesc, Rgb, SceneSphere,
};

/// A pillar of infinite height around the y axis.
struct Pillar {
    radius: f32,
}

impl Visibility for Pillar {
    fn unoccluded(&self, from: Vec3, to: Vec3) -> bool {
        let along = Vec3::new(to.x - from.x, 0.0, to.z - from.z);
        let t =
            -(from.x * along.x + from.z * along.z) / along.length_squared().max(f32::MIN_POSITIVE);
        let nearest = from + (to - from) * t.clamp(0.0, 1.0);
        nearest.x.hypot(nearest.z) > self.radius
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a shade from 0 to 9"
)]
fn main() -> Result<(), Box<dyn core::error::Error>> {
    let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 20.0)?);
    for (x, intensity) in [(-2.5, 4.0), (0.3, 12.0), (3.0, 6.0)] {
        lights.add(LightDesc::Point(PointLightDesc {
            position: Vec3::new(x, 0.5, 3.0),
            emission: Vec3::ONE,
            amount: IntensityAmount::Radiometric(intensity),
            media: MediumInterface::default(),
        }))?;
    }
    let lights = lights.build();
    let fog = Homogeneous::<Rgb> {
        substance: Substance::new(Vec3::splat(0.01), Vec3::splat(0.12), Vec3::ZERO)?,
        phase: Phase::HenyeyGreenstein(HenyeyGreenstein::new(0.5)?),
        region: Region::UNBOUNDED,
    };
    let integrator = VolumeIntegrator {
        medium: &fog,
        lights: &lights,
        sampler: &PowerLightSampler::new(&lights.powers())?,
        scene: &Pillar { radius: 0.6 },
        wavelengths: &(),
        step: StepSize::new(0.25)?,
        shadow_step: StepSize::new(0.5)?,
    };

    let (width, height) = (78, 24);
    for y in 0..height {
        let line = (0..width).map(|x| {
            let d = Vec3::new(
                x as f32 / width as f32 - 0.5,
                0.35 - 0.7 * y as f32 / height as f32,
                1.0,
            )
            .normalize();
            let ray = Ray {
                o: Vec3::new(0.0, 0.0, -8.0),
                d,
            };
            let seed = y * width + x;
            // A Latin hypercube a pixel serves as the stream of random numbers.
            let numbers = LatinHypercube::new(1 << 16, seed);
            let mut drawn = 0;
            let mut next_u = || {
                drawn += 1;
                numbers.point_f32::<1>(drawn)[0]
            };
            let marches = 64;
            let through = Span { t0: 0.0, t1: 16.0 };
            let sum: f32 = (0..marches)
                .map(|i| {
                    integrator
                        .single_scattering(&ray, through, seed * marches + i, &mut next_u)
                        .l
                        .x
                })
                .sum();
            let shade = (sum / marches as f32 * 60.0).sqrt().min(9.0);
            char::from(b" .:-=+*#%@"[shade as usize])
        });
        println!("{}", line.collect::<String>());
    }
    Ok(())
}
