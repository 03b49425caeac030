//! Light samples and phase samples, weighted, have the mean of either and less noise than light
//! samples alone.

use light_math::fraction;
use light_math::glam::{Affine3A, Vec2, Vec3};
use light_media::phase::HenyeyGreenstein;
use light_media::{
    Homogeneous, Phase, Region, ScatteringNumbers, ScatteringPoint, StepSize, Substance,
    VolumeIntegrator,
};
use light_samplers::UniformLightSampler;
use light_sources::shape::ShapeDesc;
use light_sources::{
    AreaLightDesc, DiffuseEmissionDesc, LightDesc, LightSetBuilder, RadianceAmount, Rgb,
    SceneSphere, SurfaceColor, UniformInfiniteLightDesc,
};
use light_testkit::{Estimate, Rng};

use crate::support::ball::{Ball, CENTRE, RADIUS};

#[test]
fn both_strategies_have_one_mean_and_together_less_noise() {
    let fog = Homogeneous::<Rgb> {
        substance: Substance::new(Vec3::splat(0.05), Vec3::splat(0.2), Vec3::ZERO).expect("valid"),
        phase: Phase::HenyeyGreenstein(HenyeyGreenstein::new(0.95).expect("in range")),
        // Light from the sky has to come in.
        region: Region::new(
            light_math::Aabb::new(Vec3::splat(-4.0), Vec3::splat(4.0)),
            Affine3A::IDENTITY,
        )
        .expect("a box"),
    };
    let mut lights =
        LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere"));
    let color = SurfaceColor::Uniform(Vec3::new(3.0, 2.0, 1.0));
    lights
        .add(LightDesc::Area(AreaLightDesc {
            shape: ShapeDesc::Sphere {
                transform: Affine3A::from_translation(CENTRE),
                radius: RADIUS,
            },
            emission: DiffuseEmissionDesc::new(color, RadianceAmount::default()),
        }))
        .expect("a light");
    lights
        .add(LightDesc::UniformInfinite(UniformInfiniteLightDesc {
            emission: Vec3::splat(0.5),
            amount: RadianceAmount::default(),
        }))
        .expect("a sky");
    let lights = lights.build();
    let step = StepSize::new(0.5).expect("positive");
    let integrator = VolumeIntegrator {
        medium: &fog,
        lights: &lights,
        sampler: &UniformLightSampler::new(2),
        scene: &Ball,
        wavelengths: &(),
        step,
        shadow_step: step,
    };
    let at = ScatteringPoint {
        p: Vec3::ZERO,
        wo: Vec3::NEG_Z,
    };
    let n = 100_000;
    let mut rng = Rng::new(5);
    let mut next_u = || rng.f32();
    let mut estimate = |mis: bool| {
        Estimate::of(n, || {
            let mut pair = || Vec2::new(next_u(), next_u());
            let (point, direction) = (pair(), pair());
            let light = fraction::from_f32(next_u(), fraction::from_f32(next_u(), 0));
            let numbers = ScatteringNumbers {
                light,
                point,
                direction,
            };
            let l = if mis {
                integrator.in_scattered_mis(at, numbers, &mut next_u)
            } else {
                integrator.in_scattered(at, light, point, &mut next_u)
            };
            f64::from(l.x)
        })
    };
    let (light, both) = (estimate(false), estimate(true));
    assert!(light.agrees_with_estimate(&both), "{light:?} and {both:?}");
    let gain = (light.standard_error / both.standard_error).powi(2);
    assert!(gain > 4.0, "the variance is divided by {gain}");
}
