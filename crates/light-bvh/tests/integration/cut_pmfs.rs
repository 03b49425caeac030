//! What a cut says of its choices is what it does.

use light_bvh::light_bounds::light_math::fraction::stratum;
use light_bvh::light_bounds::light_math::glam::Vec3;
use light_bvh::light_bounds::{LightExtent, LightId, LightSampleContext, SampledLight};
use light_bvh::{CutDetail, LightBvh, LightCut};
use light_testkit::Rng;

use crate::support::lamp;

/// Lights.
const COUNT: u32 = 600;

/// Choices.
const SAMPLES: u32 = 100_000;

fn tree() -> LightBvh {
    let mut rng = Rng::new(1);
    let lights: Vec<LightExtent> = (0..COUNT)
        .map(|_| lamp(rng.vec3() + Vec3::Z, rng.log_range(0.01, 10.0)))
        .collect();
    LightBvh::build(&lights).expect("valid lights")
}

/// Pmfs sum to one, samples have the bits of the query, and light
/// comes as often as its pmf says: halving any of them fails.
#[test]
fn a_cut_does_as_its_pmfs_say() {
    let tree = tree();
    let view = tree.view();
    let n = Vec3::Z;
    let contexts = [
        LightSampleContext::medium(Vec3::splat(0.5)),
        LightSampleContext::surface(Vec3::splat(0.2), n, n),
        LightSampleContext::segment(Vec3::ZERO, Vec3::ONE),
    ];
    for ctx in &contexts {
        let cut = view.cut(ctx, CutDetail::default());
        let pmfs: Vec<f32> = (0..COUNT).map(|id| cut.pmf(LightId(id))).collect();
        let sum: f64 = pmfs.iter().copied().map(f64::from).sum();
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");
        let mut counts = vec![0u32; COUNT as usize];
        for i in 0..SAMPLES {
            let chosen = cut.sample(stratum(i, SAMPLES, 1 << 63)).expect("a light");
            let asked = pmfs[chosen.light.index()];
            assert_eq!(chosen.pmf.to_bits(), asked.to_bits(), "{chosen:?}");
            counts[chosen.light.index()] += 1;
        }
        for (count, pmf) in counts.iter().zip(&pmfs) {
            // Of equally spaced numbers an interval holds its width, but for one at either end.
            let expected = f64::from(SAMPLES) * f64::from(*pmf);
            assert!(
                (f64::from(*count) - expected).abs() < 1.1,
                "{count} of {expected}"
            );
        }
    }
}

/// A cut that is set has nothing left of what it was: a large one, a small one, the default.
#[test]
fn a_cut_that_is_set_is_as_a_new_one() {
    let tree = tree();
    let few = LightBvh::build(&[lamp(Vec3::Z, 1.0), lamp(Vec3::X, 2.0)]).expect("valid lights");
    let (inside, apart) = (Vec3::splat(0.5), Vec3::splat(50.0));
    let mut kept = LightCut::default();
    assert_eq!(kept.sample(0), None, "no light");
    assert_eq!(
        (kept.irradiance(), kept.pmf(LightId(0))),
        (0.0, 0.0),
        "nor any"
    );
    for (tree, p) in [
        (&tree, inside),
        (&tree, apart),
        (&few, inside),
        (&tree, inside),
    ] {
        let ctx = LightSampleContext::medium(p);
        kept.set(&tree.view(), &ctx, CutDetail::default());
        let new = tree.view().cut(&ctx, CutDetail::default());
        assert_eq!(kept.irradiance(), new.irradiance(), "at {p}");
        for i in 0..500 {
            let u = stratum(i, 500, 1 << 63);
            assert_eq!(kept.sample(u), new.sample(u), "at {p}");
            assert_eq!(kept.pmf(LightId(i)), new.pmf(LightId(i)), "at {p}");
        }
    }
}

/// Every light owns a part of all `u`, though the sum of all weights in single precision does not
/// know of it.
#[test]
fn lights_below_the_precision_of_the_sum_are_chosen() {
    let places = [Vec3::new(0.0, 0.0, 100.0), Vec3::new(10.0, 0.0, 100.0)];
    let ctx = LightSampleContext::medium(Vec3::ZERO);
    for powers in [[1.0, 1e-9], [1e-9, 1.0]] {
        let lights = [0, 1].map(|i| lamp(places[i], powers[i]));
        let tree = LightBvh::build(&lights).expect("valid lights");
        let view = tree.view();
        let cut = view.cut(&ctx, CutDetail::default());
        // The faint one comes first, or it comes last.
        let ends = [0, u64::MAX];
        let is_faint = |chosen: Option<SampledLight>| chosen.expect("a light").pmf < 0.5;
        let by_cut = ends.map(|u| is_faint(cut.sample(u)));
        let plain = ends.map(|u| is_faint(tree.sample(&ctx, u)));
        for faint in [by_cut, plain] {
            assert_ne!(faint[0], faint[1], "{powers:?}: {faint:?}");
        }
    }
}
