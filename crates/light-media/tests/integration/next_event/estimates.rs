//! Estimates against quadrature and closed forms.

use light_math::Aabb;
use light_math::glam::{Affine3A, Quat, Vec3};
use light_media::{Homogeneous, Region, Span, StepSize, Substance, VolumeIntegrator};
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, LightSampler, PowerLightSampler,
    ReferenceBvhLightSampler,
};
use light_sources::{
    DistantLightDesc, IntensityAmount, IrradianceAmount, LightDesc, LightSetBuilder,
    PointLightDesc, Rgb, SceneSphere, SpotLightDesc,
};
use light_testkit::{Estimate, Rng};

use super::{NothingInTheWay, RAY, TWO, lights, medium};

/// The mean over calls of so many samples each; `marched`: by the classic march in their place.
fn estimate(
    medium: &Homogeneous<Rgb>,
    points: &[(Vec3, f32)],
    powers: &[f32],
    span: Span,
    calls: u32,
    samples: Option<u32>,
) -> Estimate {
    let lights = lights(points);
    let step = StepSize::new(0.05).expect("positive");
    let integrator = VolumeIntegrator {
        medium,
        lights: &lights,
        sampler: &PowerLightSampler::new(powers).expect("powers"),
        scene: &NothingInTheWay,
        wavelengths: &(),
        step,
        shadow_step: step,
    };
    let mut rng = Rng::new(61);
    Estimate::of(calls, || {
        let seed = rng.u32();
        let mut next_u = || rng.f32();
        let seen = match samples {
            Some(samples) => integrator.next_event(&RAY, span, samples, seed, &mut next_u),
            None => integrator.single_scattering(&RAY, span, seed, &mut next_u),
        };
        seen.l.x.into()
    })
}

/// Light of both, scattered once, along the first four units of a ray, by the midpoint rule.
fn truth(sigma_a: f64, sigma_s: f64) -> f64 {
    let n = 40_000;
    let h = 4.0 / f64::from(n);
    let at = |i: i32| {
        let t = (f64::from(i) + 0.5) * h;
        let of = |(position, intensity): (Vec3, f32)| {
            let d = f64::from((position - RAY.at(t as f32)).length());
            let left = (-(sigma_a + sigma_s) * (t + d)).exp();
            left * sigma_s * f64::from(intensity) / (4.0 * core::f64::consts::PI * d * d)
        };
        TWO.into_iter().map(of).sum::<f64>() * h
    };
    (0..n).map(at).sum()
}

/// Whatever the probabilities of two lights, with one sample a call and with several.
#[test]
fn unequal_lights_add_up() {
    let medium = medium(0.1, 0.3, 0.0);
    let (span, truth) = (Span { t0: 0.0, t1: 4.0 }, truth(0.1, 0.3));
    for powers in [[0.2, 0.8], [0.7, 0.3]] {
        for samples in [Some(1), Some(4), None] {
            let found = estimate(&medium, &TWO, &powers, span, 1 << 13, samples);
            assert!(
                found.agrees_with(truth),
                "{powers:?}, {samples:?}: {found:?}, {truth}"
            );
        }
    }
}

/// A ray without end, through a medium in which light dies out.
#[test]
fn rays_without_end_see_all_of_the_light() {
    let medium = medium(0.5, 1.5, 0.0);
    let endless = Span {
        t0: 0.0,
        t1: f32::INFINITY,
    };
    let found = estimate(&medium, &TWO, &[0.5, 0.5], endless, 1 << 14, Some(4));
    // Beyond four units is less than exp(-8) of the light.
    let truth = truth(0.5, 1.5);
    let margin = found.margin(truth) + 1e-4 * truth;
    assert!((found.mean - truth).abs() <= margin, "{found:?}, {truth}");
}

/// A fog through which one colour is seen a hundred times farther than the others: all of it counts.
#[test]
fn rays_without_end_see_each_colour_as_far_as_it_reaches() {
    let sigma_a = Vec3::new(0.01, 3.0, 1.0);
    let medium = Homogeneous {
        substance: Substance::new(sigma_a, Vec3::ZERO, Vec3::ONE).expect("valid"),
        ..medium(0.0, 0.0, 0.0)
    };
    let endless = Span {
        t0: 0.0,
        t1: f32::INFINITY,
    };
    let found = estimate(&medium, &TWO, &[0.5, 0.5], endless, 1 << 10, Some(4));
    assert!(found.agrees_with(1.0), "{found:?}");
}

/// Points where the medium is seen have the density of what is seen of it: a glowing medium has no
/// noise.
#[test]
fn glow_has_no_noise() {
    for length in [0.5, 4.0] {
        let span = Span {
            t0: 0.5,
            t1: 0.5 + length,
        };
        let truth = 3.0 * (1.0 - f64::from(-0.7 * length).exp());
        for samples in [1, 16] {
            let found = estimate(
                &medium(0.7, 0.0, 3.0),
                &TWO,
                &[0.5, 0.5],
                span,
                64,
                Some(samples),
            );
            let is_exact = (found.mean / truth - 1.0).abs() < 1e-4;
            assert!(
                is_exact && found.standard_error < 1e-5,
                "{samples}: {found:?}, {truth}"
            );
        }
        let marched = estimate(&medium(0.7, 0.0, 3.0), &TWO, &[0.5, 0.5], span, 4096, None);
        assert!(
            (marched.mean / truth - 1.0).abs() < 2e-3,
            "march: {marched:?}, {truth}"
        );
    }
}

/// Where nothing is left at the end of the ray, the thickness is as large as floats go, not
/// infinite.
#[test]
fn an_opaque_medium_glows_as_it_is() {
    let span = Span { t0: 0.0, t1: 10.0 };
    let found = estimate(
        &medium(40.0, 0.0, 2.0),
        &TWO,
        &[0.5, 0.5],
        span,
        1 << 12,
        Some(16),
    );
    assert!(found.agrees_with(2.0), "{found:?}");
}

/// Sixteen samples of a call have places of their own on the ray: their mean has far less than a
/// sixteenth of the variance.
#[test]
fn samples_of_a_call_are_stratified() {
    let medium = medium(0.1, 0.3, 0.0);
    let span = Span { t0: 0.0, t1: 4.0 };
    let one = &TWO[..1];
    let error = |samples| estimate(&medium, one, &[1.0], span, 2048, Some(samples)).standard_error;
    let (alone, together) = (error(1), error(16));
    assert!(together < 0.15 * alone, "{together} of {alone}");
}

/// A sun over a slab that starts far along the ray: what reaches the middle of the slab is weaker
/// by the unit of medium over it.
#[test]
fn a_sun_over_a_medium_that_starts_later() {
    let slab = Aabb::new(Vec3::new(2.0, -1.0, -1.0), Vec3::new(5.0, 1.0, 1.0));
    let medium = Homogeneous {
        region: Region::new(slab, Affine3A::IDENTITY).expect("a box"),
        ..medium(0.1, 0.4, 0.0)
    };
    let scene = SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere");
    let mut lights = LightSetBuilder::<Rgb>::new(scene);
    let sun = DistantLightDesc {
        direction: Vec3::Y,
        emission: Vec3::ONE,
        amount: IrradianceAmount::Radiometric(3.0),
    };
    lights.add(LightDesc::Distant(sun)).expect("a sun");
    let step = StepSize::new(0.05).expect("positive");
    let integrator = VolumeIntegrator {
        medium: &medium,
        lights: &lights.build(),
        sampler: &PowerLightSampler::new(&[1.0]).expect("a power"),
        scene: &NothingInTheWay,
        wavelengths: &(),
        step,
        shadow_step: step,
    };
    let endless = Span {
        t0: 0.5,
        t1: f32::INFINITY,
    };
    let mut rng = Rng::new(62);
    let found = Estimate::of(1 << 12, || {
        let seed = rng.u32();
        let seen = integrator.next_event(&RAY, endless, 4, seed, &mut || rng.f32());
        seen.l.x.into()
    });
    let sigma_t = 0.5f64;
    let along = (1.0 - (-3.0 * sigma_t).exp()) / sigma_t;
    let truth = 0.4 * 3.0 / (4.0 * core::f64::consts::PI) * (-sigma_t).exp() * along;
    let margin = found.margin(truth) + 1e-4 * truth;
    assert!((found.mean - truth).abs() <= margin, "{found:?}, {truth}");
}

/// A spot that lights the middle of the ray and not its start is found by every sampler.
#[test]
fn a_spot_beside_the_start_of_the_ray() {
    let scene = SceneSphere::new(Vec3::ZERO, 100.0).expect("a sphere");
    let mut lights = LightSetBuilder::<Rgb>::new(scene);
    let down = Quat::from_rotation_arc(Vec3::Z, Vec3::NEG_Y);
    let spot = Affine3A::from_rotation_translation(down, Vec3::new(5.0, 3.0, 0.0));
    let bright = IntensityAmount::Radiometric(100.0);
    let spot = SpotLightDesc::new(spot, 0.4, Vec3::ONE, bright);
    lights.add(spot).expect("a spot");
    let weak = IntensityAmount::Radiometric(1.0);
    let bulb = PointLightDesc::new(Vec3::Y, Vec3::ONE, weak);
    lights.add(bulb).expect("a bulb");
    let lights = lights.build();
    let (extents, step) = (lights.extents(), StepSize::new(0.1).expect("positive"));
    let samplers: [(&str, Box<dyn LightSampler>); 3] = [
        (
            "default",
            Box::new(BvhLightSampler::new(&extents).expect("valid")),
        ),
        (
            "exhaustive",
            Box::new(ExhaustiveLightSampler::new(&extents).expect("valid")),
        ),
        (
            "reference",
            Box::new(ReferenceBvhLightSampler::new(&extents).expect("valid")),
        ),
    ];
    let span = Span { t0: 0.0, t1: 10.0 };
    for (name, sampler) in samplers {
        let integrator = VolumeIntegrator {
            medium: &medium(0.02, 0.1, 0.0),
            lights: &lights,
            sampler: &*sampler,
            scene: &NothingInTheWay,
            wavelengths: &(),
            step,
            shadow_step: step,
        };
        let mut rng = Rng::new(67);
        let seen = Estimate::of(20_000, || {
            let seed = rng.u32();
            let seen = integrator.next_event(&RAY, span, 4, seed, &mut || rng.f32());
            seen.l.x.into()
        });
        // By the midpoint rule.
        assert!(seen.agrees_with(0.0888), "{name}: {seen:?}");
    }
}
