//! Refits: the same tree for the same lights, every law kept for others, nothing harmed by an error.
//! `allocations.rs` shows that they allocate nothing.

use light_bvh::light_bounds::light_math::fraction::stratum;
use light_bvh::light_bounds::light_math::glam::Vec3;
use light_bvh::light_bounds::{
    InfiniteBounds, LightBounds, LightBoundsError, LightExtent, LightId, LightSampleContext,
};
use light_bvh::{LightBvh, LightBvhError, LightBvhOptions};
use light_testkit::Rng;

use crate::support::lamp;

fn lamps(n: u32, seed: u64) -> Vec<LightExtent> {
    let mut rng = Rng::new(seed);
    (0..n)
        .map(|_| {
            let at = rng.vec3();
            lamp(at, rng.log_range(0.01, 10.0))
        })
        .collect()
}

const MODES: [LightBvhOptions; 3] = [
    LightBvhOptions::QUALITY,
    LightBvhOptions::FAST,
    LightBvhOptions::DYNAMIC,
];

fn pmf_sum(tree: &LightBvh, lights: usize, ctx: &LightSampleContext) -> f64 {
    let ids = (0..).map(LightId).take(lights);
    ids.map(|id| f64::from(tree.pmf(ctx, id))).sum()
}

#[test]
fn the_same_lights_give_the_same_bits() {
    for n in [1, 8, 9, 3000] {
        let lights = lamps(n, 1);
        for options in MODES {
            let tree = LightBvh::build_with(&lights, &options).expect("valid lights");
            let mut refitted = tree.clone();
            let other = lamps(n, 2);
            refitted.refit(&other).expect("as many");
            let rebuilt = LightBvh::build_with(&other, &options).expect("valid lights");
            assert_eq!(refitted.power(), rebuilt.power(), "{n} other lights");
            refitted.refit(&lights).expect("as many");
            assert_eq!(refitted.view().nodes(), tree.view().nodes(), "{n} lights");
            assert_eq!(refitted.power(), tree.power(), "{n} lights");
        }
    }
}

#[test]
fn lights_go_off_and_on() {
    let on = lamps(500, 3);
    let mut rng = Rng::new(4);
    let some = |e: &LightExtent| match e {
        LightExtent::Bounded(b) if rng.f32() < 0.5 => {
            let mut off = *b;
            off.phi = 0.0;
            LightExtent::Bounded(off)
        }
        other => *other,
    };
    let half: Vec<LightExtent> = on.iter().map(some).collect();
    let ctx = LightSampleContext::medium(Vec3::new(0.3, 0.2, -0.5));
    for first in [&on, &half] {
        let mut tree =
            LightBvh::build_with(first, &LightBvhOptions::DYNAMIC).expect("valid lights");
        for lights in [&half, &on, &half] {
            tree.refit(lights).expect("as many");
            for (id, extent) in (0..).map(LightId).zip(lights) {
                let shines = extent.bounded().is_some_and(|b| b.phi > 0.0);
                assert_eq!(tree.pmf(&ctx, id) > 0.0, shines, "{id:?}");
            }
            let sum = pmf_sum(&tree, 500, &ctx);
            assert!((sum - 1.0).abs() < 1e-4, "{sum}");
        }
    }
}

#[test]
fn all_lights_may_be_off() {
    let lights: Vec<LightExtent> = (0..100).map(|i| lamp(Vec3::X * i as f32, 0.0)).collect();
    let ctx = LightSampleContext::medium(Vec3::Y);
    let mut tree = LightBvh::build_with(&lights, &LightBvhOptions::DYNAMIC).expect("valid lights");
    assert_eq!(tree.sample(&ctx, 1 << 63), None, "nothing shines");
    assert_eq!(pmf_sum(&tree, 100, &ctx), 0.0, "nothing shines");
    assert_eq!(tree.view().at(&ctx).irradiance(), 0.0, "nothing shines");
    tree.refit(&lamps(100, 5)).expect("as many");
    assert!((pmf_sum(&tree, 100, &ctx) - 1.0).abs() < 1e-4, "on");
    tree.refit(&lights).expect("as many");
    assert_eq!(tree.sample(&ctx, 1 << 63), None, "off again");
    assert_eq!(tree.degradation(), 0.0, "no groups");
}

#[test]
fn errors_leave_the_tree_as_it_was() {
    let mut lights = lamps(100, 6);
    lights[7] = lamp(Vec3::ONE, 0.0);
    lights[9] = LightExtent::Infinite(InfiniteBounds::uniform(1.0));
    let mut tree = LightBvh::build(&lights).expect("valid lights");
    let untouched = tree.clone();
    let light = LightId;
    let cases = [
        (
            7,
            lamp(Vec3::ONE, 1.0),
            LightBvhError::NoPlace { light: light(7) },
        ),
        (9, lights[0], LightBvhError::NoPlace { light: light(9) }),
        (8, lights[9], LightBvhError::NoPlace { light: light(8) }),
        (
            3,
            lamp(Vec3::ONE, f32::NAN),
            LightBvhError::BadBounds {
                light: light(3),
                reason: LightBoundsError::Power,
            },
        ),
        (
            99,
            lamp(Vec3::splat(1e37), 1.0),
            LightBvhError::TooFar { light: light(99) },
        ),
    ];
    for (index, bad, error) in cases {
        let mut changed = lamps(100, 7);
        (changed[7], changed[9]) = (lights[7], lights[9]);
        changed[index] = bad;
        assert_eq!(tree.refit(&changed), Err(error), "light {index}");
    }
    assert_eq!(
        tree.refit(&lights[1..]),
        Err(LightBvhError::OtherLights { expected: 100 }),
        "one too few"
    );
    assert_eq!(tree.view().nodes(), untouched.view().nodes(), "unharmed");
    assert_eq!(tree.power(), untouched.power(), "unharmed");
}

#[test]
fn a_tree_gets_looser_as_its_lights_mix_and_not_by_scale() {
    let lights = lamps(3000, 8);
    let mut tree = LightBvh::build(&lights).expect("valid lights");
    let fresh = tree.degradation();
    assert!(fresh > 0.0 && fresh < 1.0, "{fresh}");
    let grown: Vec<LightExtent> = lights.iter().map(|e| moved(e, |p| p * 1024.0)).collect();
    tree.refit(&grown).expect("as many");
    assert!((tree.degradation() / fresh - 1.0).abs() < 1e-3, "scaled");
    let mut rng = Rng::new(9);
    let mut last = fresh;
    for amount in [0.1, 0.3, 1.0] {
        let mut jitter = |p: Vec3| p + amount * (rng.vec3() - 0.5);
        let mixed: Vec<LightExtent> = lights.iter().map(|e| moved(e, &mut jitter)).collect();
        tree.refit(&mixed).expect("as many");
        assert!(tree.degradation() > last * 1.02, "moved by up to {amount}");
        last = tree.degradation();
    }
}

fn moved(extent: &LightExtent, to: impl FnOnce(Vec3) -> Vec3) -> LightExtent {
    let bounds = extent.bounded().expect("a lamp");
    lamp(to(bounds.bounds.min), bounds.phi)
}

/// Nodes of lights that are all off keep the places of their lights.
#[test]
fn lights_that_all_start_dark_are_found_when_they_are_on() {
    let lit = lamps(300, 5);
    let dark: Vec<_> = lit.iter().map(|light| switched_off(*light)).collect();
    let mut tree = LightBvh::build_with(&dark, &LightBvhOptions::DYNAMIC).expect("valid lights");
    tree.refit(&lit).expect("as many");
    let ctx = LightSampleContext::surface(Vec3::new(0.5, 0.5, -2.0), Vec3::Z, Vec3::Z);
    let sum = pmf_sum(&tree, lit.len(), &ctx);
    assert!((sum - 1.0).abs() < 1e-4, "{sum}");
    for i in 0..512 {
        let u = stratum(i, 512, 1 << 63);
        let sample = tree.sample(&ctx, u).expect("lit");
        let pmf = tree.pmf(&ctx, sample.light);
        assert_eq!(sample.pmf, pmf, "{u}: {:?}", sample.light);
    }
}

fn switched_off(light: LightExtent) -> LightExtent {
    match light {
        LightExtent::Bounded(bounds) => LightExtent::Bounded(LightBounds { phi: 0.0, ..bounds }),
        other => other,
    }
}
