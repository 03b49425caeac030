//! Media and integrators give the values that they gave before, with software float functions on
//! every target.
//!
//! A change that moves them is *value-breaking* and says so in the changelog. The new table is what
//! the failed test prints: `cargo test -p light-media --features libm --test integration
//! value_stability::`.

use light_math::Aabb;
use light_math::glam::{Affine3A, Vec2, Vec3};
use light_media::phase::{HenyeyGreenstein, MieHazy, MieMurky, Rayleigh, Schlick};
use light_media::{
    DensityGrid, ExponentialHeight, Glow, GridMedium, Homogeneous, Medium, Phase, Ray, Region,
    Span, StepSize, Substance, Visibility, VolumeIntegrator, delta_tracking, emission,
    transmittance,
};
use light_samplers::UniformLightSampler;
use light_sources::{IntensityAmount, LightSet, LightSetBuilder, PointLightDesc, Rgb, SceneSphere};
use light_testkit::{Fingerprint, Rng, assert_pinned};

/// What each phase function and each medium gives, as a fingerprint of all bits.
const PINNED: &[(&str, u64)] = &[
    ("isotropic", 0xb5614355e4b38f62),
    ("Henyey-Greenstein", 0xe69bf9e7c19df117),
    ("Schlick", 0x27e24d8018457e06),
    ("Rayleigh", 0x28e5e6cdb18662e5),
    ("hazy Mie", 0xdbc95c9e36720bf6),
    ("murky Mie", 0xb93c84dc351e4583),
    ("homogeneous", 0xbb17c2d04054d12d),
    ("exponential height", 0xd1492e2b2d1d71b5),
    ("grid", 0x6aea1275bc94d7c1),
];

fn of_phase(phase: Phase) -> u64 {
    let mut all = Fingerprint::default();
    let mut rng = Rng::new(5);
    for _ in 0..256 {
        let wo = rng.direction();
        let sample = phase.sample(wo, Vec2::new(rng.f32(), rng.f32()));
        all.add(sample.wi.to_array());
        all.add([sample.pdf, phase.pdf(wo, rng.direction())]);
    }
    all.value()
}

fn phases() -> Vec<(&'static str, u64)> {
    let valid = "a valid asymmetry";
    let forward = HenyeyGreenstein::new(0.6).expect(valid);
    let schlick = Schlick::from_asymmetry(-0.3).expect(valid);
    vec![
        ("isotropic", of_phase(Phase::default())),
        (
            "Henyey-Greenstein",
            of_phase(Phase::HenyeyGreenstein(forward)),
        ),
        ("Schlick", of_phase(Phase::Schlick(schlick))),
        ("Rayleigh", of_phase(Phase::Rayleigh(Rayleigh))),
        ("hazy Mie", of_phase(Phase::MieHazy(MieHazy))),
        ("murky Mie", of_phase(Phase::MieMurky(MieMurky))),
    ]
}

struct NothingInTheWay;

impl Visibility for NothingInTheWay {
    fn unoccluded(&self, _: Vec3, _: Vec3) -> bool {
        true
    }
}

fn lamps() -> LightSet<Rgb> {
    let scene = SceneSphere::new(Vec3::ZERO, 8.0).expect("a sphere");
    let mut builder = LightSetBuilder::new(scene);
    for x in [-0.5, 0.75] {
        let amount = IntensityAmount::Radiometric(3.0);
        let lamp = PointLightDesc::new(Vec3::new(x, 1.0, 0.5), Vec3::ONE, amount);
        builder.add(lamp).expect("a lamp");
    }
    builder.build()
}

fn of_medium(medium: &impl Medium<Rgb>) -> u64 {
    let mut all = Fingerprint::default();
    let mut rng = Rng::new(6);
    let lamps = lamps();
    let step = StepSize::new(0.25).expect("positive");
    let integrator = VolumeIntegrator {
        medium,
        lights: &lamps,
        sampler: &UniformLightSampler::new(2),
        scene: &NothingInTheWay,
        wavelengths: &(),
        step,
        shadow_step: step,
    };
    for seed in 0..32 {
        let ray = Ray {
            o: Vec3::new(rng.f32(), rng.f32(), rng.f32()) - 0.5,
            d: rng.direction(),
        };
        let span = Span { t0: 0.0, t1: 3.0 };
        let mut next = || rng.f32();
        let marched = transmittance::march::<Rgb, _>(medium, &ray, span, step, 0.5, &());
        all.add(marched.to_array());
        let tracked = transmittance::ratio_tracking::<Rgb, _>(medium, &ray, span, &(), &mut next);
        all.add(tracked.to_array());
        let flight = delta_tracking::<Rgb, _>(medium, &ray, span, Vec3::ONE, &(), &mut next);
        all.add(flight.weight.to_array());
        all.add(flight.emitted.to_array());
        let glow = emission::<Rgb, _>(medium, &ray, span, step, &(), &mut next);
        all.add(glow.l.to_array());
        let single = integrator.single_scattering(&ray, span, seed, &mut next);
        all.add(single.l.to_array());
        let asked = integrator.next_event(&ray, span, 4, seed, &mut next);
        all.add(asked.l.to_array());
    }
    all.value()
}

fn media() -> Vec<(&'static str, u64)> {
    let tint = Vec3::new(1.0, 0.5, 0.25);
    let substance = || Substance::new(tint * 0.5, tint, Vec3::splat(0.25)).expect("valid");
    let phase = Phase::HenyeyGreenstein(HenyeyGreenstein::new(0.5).expect("valid"));
    let homogeneous = Homogeneous {
        substance: substance(),
        phase,
        region: Region::UNBOUNDED,
    };
    let up = Vec3::new(0.25, 1.0, 0.0);
    let everywhere = Region::UNBOUNDED;
    let height = ExponentialHeight::new(substance(), phase, everywhere, Vec3::ZERO, up, 2.0);
    let values = (0..6 * 5 * 4u16).map(|i| f32::from(i * 37 % 11) * 0.25);
    let density = DensityGrid::new([6, 5, 4], values.collect::<Vec<_>>()).expect("valid");
    let cube = Aabb::new(Vec3::splat(-1.0), Vec3::ONE);
    let place = Affine3A::IDENTITY;
    let grid = GridMedium::new(substance(), phase, cube, place, density, Glow::uniform());
    vec![
        ("homogeneous", of_medium(&homogeneous)),
        ("exponential height", of_medium(&height.expect("valid"))),
        ("grid", of_medium(&grid.expect("valid"))),
    ]
}

#[test]
fn values_are_those_of_before() {
    assert_pinned(&[phases(), media()].concat(), PINNED);
}
