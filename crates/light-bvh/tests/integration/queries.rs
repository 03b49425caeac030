//! Queries of a tree itself: by groups, without a receiver, from far away and where nothing lights.

use core::f32::consts::PI;

use light_bvh::light_bounds::light_math::fraction::stratum;
use light_bvh::light_bounds::light_math::glam::Vec3;
use light_bvh::light_bounds::{Gloss, LightExtent, LightGroups, LightId, LightSampleContext};
use light_bvh::{CutDetail, GlossyReceiver, LightBvh, LightBvhError};
use light_testkit::Rng;

use crate::support::lamp;

/// More lights than a tree of 256 nodes holds.
const COUNT: u32 = 6000;

fn tree() -> LightBvh {
    let mut rng = Rng::new(7);
    let lights: Vec<LightExtent> = (0..COUNT)
        .map(|_| lamp(rng.vec3() + Vec3::Z, rng.log_range(0.01, 10.0)))
        .collect();
    LightBvh::build(&lights).expect("valid lights")
}

fn sum(pmf: impl FnMut(LightId) -> f32) -> f64 {
    (0..COUNT).map(LightId).map(pmf).map(f64::from).sum()
}

/// One light of 97 is in group 1, one of 5 in group 2.
fn groups() -> Vec<LightGroups> {
    let of = |id: u32, every: u32, group| match id % every {
        0 => LightGroups::of(group),
        _ => LightGroups::NONE,
    };
    (0..COUNT).map(|id| of(id, 97, 1) | of(id, 5, 2)).collect()
}

/// A light outside the groups asked for has probability 0 in every kind of query, and the others
/// share 1.
#[test]
fn only_lights_of_the_groups_of_the_context_are_chosen() {
    let (mut tree, groups) = (tree(), groups());
    assert!(tree.groups().is_empty(), "none yet");
    let short = tree.set_groups(&groups[1..]);
    let expected = COUNT as usize;
    assert_eq!(
        short,
        Err(LightBvhError::OtherLights { expected }),
        "one short"
    );
    tree.set_groups(&groups).expect("as many");
    assert_eq!(tree.groups().len(), tree.view().nodes().len(), "all nodes");
    for wanted in [1, 2].map(LightGroups::of) {
        let ctx = LightSampleContext::medium(Vec3::splat(0.3)).with_groups(wanted);
        let (view, cut) = (tree.view(), tree.view().cut(&ctx, CutDetail::default()));
        for (id, of_light) in (0..).map(LightId).zip(&groups) {
            let is_wanted = of_light.is_wanted(wanted);
            assert_eq!(view.pmf(&ctx, id) > 0.0, is_wanted, "{id:?}");
            assert_eq!(cut.pmf(id) > 0.0, is_wanted, "{id:?} of a cut");
        }
        let sums = [sum(|id| view.pmf(&ctx, id)), sum(|id| cut.pmf(id))];
        assert!(sums.iter().all(|sum| (sum - 1.0).abs() < 1e-5), "{sums:?}");
        for u in (0..500).map(|i| stratum(i, 500, 1 << 63)) {
            let [one, of_cut] = [view.sample(&ctx, u), cut.sample(u)].map(Option::unwrap);
            assert_eq!(one.pmf, view.pmf(&ctx, one.light), "{one:?}");
            assert_eq!(of_cut.pmf, cut.pmf(of_cut.light), "{of_cut:?}");
        }
    }
    let nobody = LightSampleContext::medium(Vec3::ZERO).with_groups(LightGroups::of(9));
    assert_eq!(tree.view().sample(&nobody, 1 << 63), None, "no such light");
    let cut = tree.view().cut(&nobody, CutDetail::default());
    assert_eq!(
        (cut.sample(1 << 63), cut.irradiance()),
        (None, 0.0),
        "a cut"
    );
}

#[test]
fn emitters_are_chosen_as_their_pmfs_say() {
    let tree = tree();
    let (mut counts, samples) = (vec![0u32; COUNT as usize], 200_000);
    for i in 0..samples {
        let chosen = tree.view().sample_emitter(stratum(i, samples, 1 << 63));
        let chosen = chosen.expect("all shine");
        assert_eq!(
            chosen.pmf,
            tree.view().pmf_emitter(chosen.light),
            "{chosen:?}"
        );
        counts[chosen.light.index()] += 1;
    }
    for (id, count) in (0..).map(LightId).zip(counts) {
        // Of equally spaced numbers an interval holds its width, but for one at either end.
        let expected = f64::from(samples) * f64::from(tree.view().pmf_emitter(id));
        assert!(
            (f64::from(count) - expected).abs() < 1.1,
            "{count} of {expected}"
        );
    }
}

/// The irradiance by a light of power 1 all around.
#[test]
fn a_cut_knows_about_the_irradiance() {
    let LightExtent::Bounded(mut bounds) = lamp(Vec3::ZERO, 3.0) else {
        panic!("bounded");
    };
    bounds.cos_theta_o = -1.0;
    let tree = LightBvh::build(&[LightExtent::Bounded(bounds)]).expect("a light");
    for distance in [0.5, 2.0, 70.0] {
        let ctx = LightSampleContext::medium(Vec3::X * distance);
        let cut = tree.view().cut(&ctx, CutDetail::default());
        let expected = 1.0 / (4.0 * PI * distance * distance);
        let ratio = cut.irradiance() / expected;
        assert!((ratio - 1.0).abs() < 0.02, "{ratio} at {distance}");
    }
}

/// So far that weights have no exponent left.
#[test]
fn lights_far_away_are_chosen_by_a_cut() {
    let tree = tree();
    for distance in [1e19, 1e30] {
        let ctx = LightSampleContext::medium(Vec3::NEG_Z * distance);
        let cut = tree.view().cut(&ctx, CutDetail::default());
        let total = sum(|id| cut.pmf(id));
        assert!((total - 1.0).abs() < 1e-5, "{total} at {distance}");
        for u in (0..100).map(|i| stratum(i, 100, 1 << 63)) {
            let chosen = cut.sample(u).expect("they shine down");
            assert_eq!(chosen.pmf, cut.pmf(chosen.light), "{chosen:?}");
        }
    }
}

/// Without a direction to the viewer nothing is mirrored.
#[test]
fn a_glossy_surface_without_a_viewer_is_diffuse() {
    let (tree, p, n) = (tree(), Vec3::splat(0.4), Vec3::Z);
    let of = |wo, diffuse| {
        let gloss = Gloss {
            wo,
            alpha: 0.1,
            diffuse,
        };
        GlossyReceiver::new(p, n, &gloss)
    };
    let diffuse = of(n, 1.0);
    for wo in [Vec3::ZERO, Vec3::NAN] {
        let unseen = of(wo, 0.2);
        for id in (0..200).map(LightId) {
            let [pmf, expected] = [&unseen, &diffuse].map(|at| tree.view().pmf(at, id));
            assert_eq!(pmf, expected, "{id:?} with {wo}");
        }
    }
}

/// One pass over the nodes finds what a query of each light finds, and each light once.
#[test]
fn one_pass_has_the_probability_of_every_light() {
    let (mut tree, groups) = (tree(), groups());
    tree.set_groups(&groups).expect("as many");
    let p = Vec3::splat(0.3);
    let all = [
        LightSampleContext::surface(p, Vec3::NEG_Z, Vec3::NEG_Z),
        LightSampleContext::medium(p),
        LightSampleContext::medium(p * 1e30),
        LightSampleContext::medium(p).with_groups(LightGroups::of(2)),
        LightSampleContext::medium(p).with_groups(LightGroups::of(5)),
    ];
    for ctx in &all {
        let mut found = vec![0.0; COUNT as usize];
        tree.view().for_each_pmf(ctx, |id, pmf| {
            assert!(found[id.index()] == 0.0 && pmf > 0.0, "{id:?} once");
            found[id.index()] = pmf;
        });
        for (id, pmf) in (0..).map(LightId).zip(&found) {
            assert_eq!(*pmf, tree.view().pmf(ctx, id), "{id:?} at {ctx:?}");
        }
    }
    let empty = LightBvh::build(&[]).expect("no lights");
    let nothing = |id, _| panic!("{id:?} in an empty tree");
    empty.view().for_each_pmf(&all[0], nothing);
}
