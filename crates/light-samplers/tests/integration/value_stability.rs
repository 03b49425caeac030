//! Samplers make the choices that they made before, with software float functions on every target.
//!
//! A change that moves them is *value-breaking* and says so in the changelog. The new table is what
//! the failed test prints: `cargo test -p light-samplers --features libm --test integration
//! value_stability::`.

use light_samplers::light_bounds::glam::Vec3;
use light_samplers::light_bounds::light_math::Aabb;
use light_samplers::light_bounds::light_math::fraction::stratum;
use light_samplers::light_bounds::{
    Gloss, InfiniteBounds, LightBounds, LightExtent, LightSampleContext,
};
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, LightSampler, PowerLightSampler,
    ReferenceBvhLightSampler, UniformLightSampler,
};
use light_testkit::{Fingerprint, Rng, assert_pinned};

/// What each sampler chooses for [`receivers`], as a fingerprint of all bits.
const PINNED: &[(&str, u64)] = &[
    ("uniform", 0x1ccb02c982bd327c),
    ("power", 0xc5f3e59ab16dec9f),
    ("exhaustive", 0xd2dadd1d4ecae56e),
    ("reference", 0xb6b3f92c24e4bded),
    ("default", 0xa6356ece1de5fee4),
];

/// Panels, points and spots in a cube, a sky and a sun.
fn lights() -> Vec<LightExtent> {
    let mut rng = Rng::new(3);
    let light = |i: u16| {
        let p = Vec3::new(rng.f32(), rng.f32(), rng.f32()) * 8.0;
        let (size, cos_theta_o, cos_theta_e) = match i % 3 {
            0 => (0.25, 1.0, 0.0),
            1 => (0.0, -1.0, 0.0),
            _ => (0.0, 0.75, 0.9375),
        };
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::new(p, p + size),
            w: rng.direction(),
            phi: 1.0 + 7.0 * rng.f32(),
            cos_theta_o,
            cos_theta_e,
            two_sided: i % 4 == 0,
        })
    };
    let mut all: Vec<_> = (0..200).map(light).collect();
    all.push(InfiniteBounds::uniform(0.25).into());
    all.push(LightExtent::Infinite(InfiniteBounds::distant(2.0, Vec3::Z)));
    all
}

/// On surfaces of all kinds, in a medium, and along a ray.
fn receivers() -> impl Iterator<Item = LightSampleContext> {
    let mut rng = Rng::new(4);
    (0..50).map(move |i| {
        let p = Vec3::new(rng.f32(), rng.f32(), rng.f32()) * 8.0;
        let n = rng.direction();
        let surface = LightSampleContext::surface(p, n, n);
        match i % 5 {
            0 => LightSampleContext::medium(p),
            1 => LightSampleContext::segment(p, 4.0 * rng.direction()),
            2 => surface.with_gloss(Gloss {
                wo: n,
                alpha: 0.25,
                diffuse: 0.5,
            }),
            _ => surface,
        }
    })
}

fn of(sampler: &impl LightSampler) -> u64 {
    const DRAWS: u32 = 16;
    let mut all = Fingerprint::default();
    for ctx in receivers() {
        for i in 0..DRAWS {
            if let Some(chosen) = sampler.sample(&ctx, stratum(i, DRAWS, 1 << 62)) {
                all.add([chosen.light.0 as f32, chosen.pmf]);
            }
        }
        for chosen in sampler.at(&ctx, 4).samples(1 << 61) {
            all.add([chosen.light.0 as f32, chosen.pmf]);
        }
    }
    for i in 0..DRAWS {
        if let Some(chosen) = sampler.sample_emitter(stratum(i, DRAWS, 1 << 62)) {
            all.add([chosen.light.0 as f32, chosen.pmf]);
        }
    }
    all.value()
}

#[test]
fn values_are_those_of_before() {
    let lights = lights();
    let powers: Vec<_> = (0..lights.len()).map(|i| (i % 7) as f32).collect();
    let valid = "valid lights";
    let found = [
        ("uniform", of(&UniformLightSampler::new(202))),
        ("power", of(&PowerLightSampler::new(&powers).expect(valid))),
        (
            "exhaustive",
            of(&ExhaustiveLightSampler::new(&lights).expect(valid)),
        ),
        (
            "reference",
            of(&ReferenceBvhLightSampler::new(&lights).expect(valid)),
        ),
        ("default", of(&BvhLightSampler::new(&lights).expect(valid))),
    ];
    assert_pinned(&found, PINNED);
}
