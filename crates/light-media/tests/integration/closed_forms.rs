//! Marches and trackers against closed forms and quadrature.

#![expect(clippy::cast_possible_truncation, reason = "quadrature in f64")]

use light_math::Aabb;
use light_math::glam::{Affine3A, Vec3};
use light_media::phase::{HenyeyGreenstein, Isotropic};
use light_media::transmittance;
use light_media::{
    DensityGrid, ExponentialHeight, Glow, GridMedium, Homogeneous, Medium, Phase, PhaseFunction,
    Ray, Region, Span, StepSize, Substance, Visibility, VolumeIntegrator, delta_tracking, emission,
};
use light_samplers::UniformLightSampler;
use light_sources::{
    IntensityAmount, LightDesc, LightSetBuilder, MediumInterface, PointLightDesc, Rgb, SceneSphere,
};
use light_testkit::{Estimate, Rng};

const RAY: Ray = Ray {
    o: Vec3::new(-0.2, 0.3, 0.4),
    d: Vec3::X,
};

fn span(t1: f32) -> Span {
    Span { t0: 0.0, t1 }
}

fn substance(sigma_a: f32, sigma_s: f32, le: f32) -> Substance<Rgb> {
    // Channels that differ, so that trackers must be right in each of them.
    let tint = Vec3::new(1.0, 0.5, 0.25);
    Substance::new(tint * sigma_a, tint * sigma_s, Vec3::splat(le)).expect("valid")
}

fn cloud(sigma_a: f32, sigma_s: f32, le: f32) -> GridMedium<Rgb, Vec<f32>> {
    let values = (0..6 * 5 * 4)
        .map(|i: u32| ((i * 37) % 11) as f32 * 0.3)
        .collect();
    let density = DensityGrid::new([6, 5, 4], values).expect("valid");
    let cube = Aabb::new(Vec3::ZERO, Vec3::new(2.0, 1.0, 1.0));
    let phase = Phase::Isotropic(Isotropic);
    GridMedium::new(
        substance(sigma_a, sigma_s, le),
        phase,
        cube,
        Affine3A::IDENTITY,
        density,
        Glow::uniform(),
    )
    .expect("valid")
}

/// Means of `n` estimates, a channel.
fn mean(n: u32, mut estimate: impl FnMut(&mut Rng) -> Vec3) -> [Estimate; 3] {
    let mut rng = Rng::new(7);
    let all: Vec<Vec3> = (0..n).map(|_| estimate(&mut rng)).collect();
    [0, 1, 2].map(|channel: usize| {
        let mut one = all.iter();
        Estimate::of(n, || one.next().map_or(f64::NAN, |x| f64::from(x[channel])))
    })
}

fn assert_agree(means: [Estimate; 3], expected: Vec3, what: &str) {
    for (mean, expected) in means.iter().zip(expected.to_array()) {
        assert!(
            mean.agrees_with(f64::from(expected)),
            "{what}: {mean:?}, expected {expected}"
        );
    }
}

fn fine_transmittance(medium: &impl Medium<Rgb>, span: Span) -> Vec3 {
    let step = StepSize::new(span.length() / 20_000.0).expect("positive");
    transmittance::march::<Rgb, _>(medium, &RAY, span, step, 0.5, &())
}

#[test]
fn beer_lambert() {
    let medium = Homogeneous {
        substance: substance(0.7, 0.4, 0.0),
        phase: Phase::Isotropic(Isotropic),
        region: Region::UNBOUNDED,
    };
    let expected = (Vec3::new(1.1, 0.55, 0.275) * -2.5).exp();
    let closed =
        transmittance::closed_form::<Rgb, _>(&medium, &RAY, span(2.5), &()).expect("closed form");
    assert!(closed.distance(expected) < 1e-6, "closed form {closed}");
    assert!(
        fine_transmittance(&medium, span(2.5)).distance(expected) < 1e-4,
        "march"
    );
    let tracked = mean(20_000, |rng| {
        transmittance::ratio_tracking::<Rgb, _>(&medium, &RAY, span(2.5), &(), &mut || rng.f32())
    });
    assert_agree(tracked, expected, "ratio tracking");
}

#[test]
fn ratio_tracking_is_unbiased_in_a_grid_and_in_fog() {
    let grid = cloud(0.8, 1.2, 0.0);
    let tracked = mean(20_000, |rng| {
        transmittance::ratio_tracking::<Rgb, _>(&grid, &RAY, span(3.0), &(), &mut || rng.f32())
    });
    assert_agree(tracked, fine_transmittance(&grid, span(3.0)), "grid");

    let phase = Phase::Isotropic(Isotropic);
    let up = Vec3::new(0.3, 1.0, 0.0);
    let fog = ExponentialHeight::new(
        substance(0.5, 0.5, 0.0),
        phase,
        Region::UNBOUNDED,
        Vec3::ZERO,
        up,
        2.0,
    )
    .expect("valid");
    let tracked = mean(20_000, |rng| {
        transmittance::ratio_tracking::<Rgb, _>(&fog, &RAY, span(4.0), &(), &mut || rng.f32())
    });
    assert_agree(tracked, fine_transmittance(&fog, span(4.0)), "fog");
}

#[test]
fn delta_tracking_passes_what_ratio_tracking_passes_and_collects_the_emission() {
    let grid = cloud(0.8, 1.2, 0.5);
    let through = |rng: &mut Rng| {
        let flight =
            delta_tracking::<Rgb, _>(&grid, &RAY, span(3.0), Vec3::ONE, &(), &mut || rng.f32());
        if flight.scattered_at.is_none() {
            flight.weight
        } else {
            Vec3::ZERO
        }
    };
    assert_agree(
        mean(40_000, through),
        fine_transmittance(&grid, span(3.0)),
        "transmittance",
    );

    let step = StepSize::new(1e-3).expect("positive");
    let marched = emission::<Rgb, _>(&grid, &RAY, span(3.0), step, &(), &mut || 0.5);
    let collected = mean(40_000, |rng| {
        delta_tracking::<Rgb, _>(&grid, &RAY, span(3.0), Vec3::ONE, &(), &mut || rng.f32()).emitted
    });
    assert_agree(collected, marched.l, "emission");
}

#[test]
fn a_glowing_slab_emits_what_it_absorbs() {
    let slab = Homogeneous {
        substance: substance(0.9, 0.0, 3.0),
        phase: Phase::Isotropic(Isotropic),
        region: Region::new(Aabb::new(Vec3::ZERO, Vec3::splat(2.0)), Affine3A::IDENTITY)
            .expect("valid"),
    };
    let expected = 3.0 * (Vec3::ONE - (Vec3::new(0.9, 0.45, 0.225) * -2.0).exp());
    let step = StepSize::new(0.05).expect("positive");
    let marched = mean(4_000, |rng| {
        emission::<Rgb, _>(&slab, &RAY, span(9.0), step, &(), &mut || rng.f32()).l
    });
    // A jittered march of exponentials is off by (sigma h)^2 / 24: below 1e-4 here.
    assert_agree(marched, expected, "(1 - exp(-sigma_a d)) Le");
}

#[test]
fn a_march_converges_to_tracking_with_the_square_of_its_step() {
    let fog = ExponentialHeight::new(
        substance(0.5, 0.0, 2.0),
        Phase::Isotropic(Isotropic),
        Region::UNBOUNDED,
        Vec3::ZERO,
        Vec3::X,
        1.5,
    )
    .expect("valid");
    let of_step = |h: f32| {
        emission::<Rgb, _>(
            &fog,
            &RAY,
            span(2.0),
            StepSize::new(h).expect("positive"),
            &(),
            &mut || 0.5,
        )
        .l
        .x
    };
    let fine = of_step(1e-3);
    let (coarse, half) = ((of_step(0.4) - fine).abs(), (of_step(0.2) - fine).abs());
    assert!(
        coarse / half > 3.0,
        "midpoint errors fall by four: {coarse} and {half}"
    );
    let tracked = mean(40_000, |rng| {
        delta_tracking::<Rgb, _>(&fog, &RAY, span(2.0), Vec3::ONE, &(), &mut || rng.f32()).emitted
    });
    assert!(
        tracked[0].agrees_with(f64::from(fine)),
        "tracking: {tracked:?}, {fine}"
    );
}

struct NothingInTheWay;

impl Visibility for NothingInTheWay {
    fn unoccluded(&self, _from: Vec3, _to: Vec3) -> bool {
        true
    }
}

#[test]
fn a_point_light_in_endless_fog() {
    let g = 0.6;
    let phase = HenyeyGreenstein::new(g).expect("in range");
    let medium = Homogeneous {
        substance: Substance::new(Vec3::splat(0.1), Vec3::splat(0.3), Vec3::ZERO).expect("valid"),
        phase: Phase::HenyeyGreenstein(phase),
        region: Region::UNBOUNDED,
    };
    let lamp = Vec3::new(1.5, 1.0, 0.4);
    let mut lights =
        LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere"));
    let desc = PointLightDesc {
        position: lamp,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(5.0),
        media: MediumInterface::default(),
    };
    lights.add(LightDesc::Point(desc)).expect("a light");
    let lights = lights.build();

    // The integral of Tr(t) sigma_s phase I / d^2 Tr(d), by the midpoint rule in f64.
    let n = 20_000;
    let h = 4.0 / f64::from(n);
    let expected: f64 = (0..n)
        .map(|i| {
            let t = (f64::from(i) + 0.5) * h;
            let to_lamp = lamp - RAY.at(t as f32);
            let d = f64::from(to_lamp.length());
            let value = f64::from(phase.value(RAY.d.dot(to_lamp.normalize())));
            (-0.4 * (t + d)).exp() * 0.3 * value * 5.0 / (d * d) * h
        })
        .sum();

    let integrator = VolumeIntegrator {
        medium: &medium,
        lights: &lights,
        sampler: &UniformLightSampler::new(1),
        scene: &NothingInTheWay,
        wavelengths: &(),
        step: StepSize::new(0.1).expect("positive"),
        shadow_step: StepSize::new(0.5).expect("positive"),
    };
    let mut seed = 0;
    let marched = mean(4_000, |rng| {
        seed += 1;
        integrator
            .single_scattering(&RAY, span(4.0), seed, &mut || rng.f32())
            .l
    });
    assert_agree(marched, Vec3::splat(expected as f32), "single scattering");
    let asked = mean(4_000, |rng| {
        seed += 1;
        integrator
            .next_event(&RAY, span(4.0), 8, seed, &mut || rng.f32())
            .l
    });
    assert_agree(asked, Vec3::splat(expected as f32), "next event");
}
