//! One test per fault of the published implementation that the robust tree must not have.

use light_bvh::LightBvhError;
use light_bvh::light_bounds::light_math::{Aabb, fraction::stratum, glam::Vec3};
use light_bvh::light_bounds::{
    LightBounds, LightBoundsError, LightExtent, LightId, LightSampleContext,
};
use light_bvh::reference::{
    BitTrail, ReferenceLightBvh, ReferenceLightBvhRef, ReferenceNode, Side,
};

fn point_light(p: Vec3) -> LightBounds {
    LightBounds {
        bounds: Aabb::from_point(p),
        w: Vec3::Z,
        phi: 1.0,
        cos_theta_o: -1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    }
}

fn lamp(p: Vec3) -> LightBounds {
    LightBounds {
        w: Vec3::NEG_Z,
        cos_theta_o: 1.0,
        ..point_light(p)
    }
}

fn build(lights: impl IntoIterator<Item = LightBounds>) -> ReferenceLightBvh {
    let lights: Vec<_> = lights.into_iter().map(LightExtent::Bounded).collect();
    ReferenceLightBvh::build(&lights).expect("valid lights")
}

/// All pmfs at `ctx`, after checking that they are probabilities, that samples repeat them, and
/// that they add up to the share of `u` that finds a light.
fn lawful_pmfs(tree: &ReferenceLightBvh, ctx: &LightSampleContext) -> Vec<f32> {
    let count = u32::try_from(tree.view().trails().len()).expect("few lights");
    let pmfs: Vec<f32> = (0..count).map(|i| tree.pmf(ctx, LightId(i))).collect();
    let sum: f64 = pmfs.iter().map(|&p| f64::from(p)).sum();
    assert!(pmfs.iter().all(|p| (0.0..=1.0).contains(p)), "{pmfs:?}");

    let draws = 512;
    let mut found = 0;
    for i in 0..draws {
        let u = stratum(i, draws, 1 << 63);
        if let Some(s) = tree.sample(ctx, u) {
            found += 1;
            assert_eq!(
                s.pmf.to_bits(),
                pmfs[s.light.index()].to_bits(),
                "same bits"
            );
        }
    }
    let share = f64::from(found) / f64::from(draws);
    assert!(
        (share - sum).abs() < 0.02 + 1e-6 * f64::from(count),
        "{share} of {sum}"
    );
    pmfs
}

#[test]
fn a_spot_without_falloff_is_picked() {
    let spot = |x: f32| LightBounds {
        cos_theta_o: 0.95,
        cos_theta_e: 1.0,
        ..lamp(Vec3::new(x, 0.0, 2.0))
    };
    let tree = build((0..20).map(|i| spot(i as f32)));
    let below = LightSampleContext::surface(Vec3::X * 7.0, Vec3::Z, Vec3::Z);
    let pmfs = lawful_pmfs(&tree, &below);
    assert!(pmfs[7] > 0.5, "the one above: {pmfs:?}");
}

#[test]
fn nested_clusters_stay_within_the_trail() {
    // Each cluster is much smaller than the one around it: a split by cost takes off a few lights
    // at a time.
    let tree = build((0..4000).map(|i| {
        let size = 0.5f32.powi(i / 40);
        point_light(Vec3::new(
            size,
            size * (i % 7) as f32,
            size * (i % 3) as f32,
        ))
    }));
    let stats = tree.stats();
    assert!(stats.max_depth <= BitTrail::MAX_DEPTH, "{stats:?}");
    assert!(stats.max_depth > 20, "else nothing is tested: {stats:?}");
    lawful_pmfs(&tree, &LightSampleContext::medium(Vec3::ZERO));
}

#[test]
fn a_million_lights_at_one_point_are_balanced() {
    let tree = build((0..1_000_000).map(|_| point_light(Vec3::ONE)));
    assert_eq!(tree.stats().max_depth, 20, "log2 of a million");
    let sample = tree
        .sample(&LightSampleContext::medium(Vec3::ZERO), 1 << 62)
        .expect("all shine");
    assert!((sample.pmf - 1e-6).abs() < 1e-7, "{}", sample.pmf);
}

#[test]
fn a_light_without_power_has_no_probability() {
    let dark = LightBounds {
        phi: 0.0,
        ..point_light(Vec3::X)
    };
    let tree = build([point_light(Vec3::ZERO), dark, point_light(Vec3::Y)]);
    let pmfs = lawful_pmfs(&tree, &LightSampleContext::medium(Vec3::Z));
    assert_eq!(pmfs[1], 0.0, "never sampled");
    assert_eq!(tree.pmf_emitter(LightId(1)), 0.0, "nor without a context");
    assert!(build([dark]).is_empty(), "nothing to hold");
}

#[test]
fn receivers_at_a_box_centre_and_on_a_light_are_ordinary() {
    let tree = build([Vec3::ZERO, Vec3::X * 2.0, Vec3::new(1.0, 5.0, 0.0)].map(point_light));
    for p in [Vec3::X, Vec3::ZERO, Vec3::new(1.0, 2.5, 0.0)] {
        for ns in [Vec3::ZERO, Vec3::Z, Vec3::Y] {
            let pmfs = lawful_pmfs(&tree, &LightSampleContext::surface(p, ns, ns));
            assert!(pmfs.iter().all(|&p| p > 0.0), "at {p}: {pmfs:?}");
        }
    }
}

#[test]
fn two_dark_children_give_none_and_zero() {
    let tree = build([lamp(Vec3::ZERO), lamp(Vec3::X)]);
    let above = LightSampleContext::medium(Vec3::Z * 3.0);
    assert_eq!(tree.sample(&above, 1 << 63), None, "both shine down");
    assert_eq!(lawful_pmfs(&tree, &above), [0.0, 0.0], "not 0 / 0");
    let alone = build([lamp(Vec3::ZERO)]);
    assert_eq!(alone.sample(&above, 1 << 63), None, "the root is a leaf");
    assert_eq!(lawful_pmfs(&alone, &above), [0.0], "nor here");
}

#[test]
fn huge_coordinates_are_ordinary() {
    for scale in [1e18, 1e19, 1e20, 1e36] {
        let at = |i: u16| Vec3::new(f32::from(i % 5), f32::from(i % 7), f32::from(i)) * scale;
        let tree = build((0..50).map(|i| point_light(at(i))));
        for p in [Vec3::ZERO, at(7), at(11) * 0.5] {
            let pmfs = lawful_pmfs(&tree, &LightSampleContext::medium(p));
            assert!(pmfs.iter().all(|&p| p > 0.0), "scale {scale}: {pmfs:?}");
        }
    }
}

#[test]
fn lights_that_are_no_numbers_are_refused_by_name() {
    let bad = |p| {
        let lights = [point_light(Vec3::ZERO), point_light(p)].map(LightExtent::Bounded);
        ReferenceLightBvh::build(&lights).map(|_| ())
    };
    for x in [f32::NAN, f32::INFINITY] {
        let error = LightBvhError::BadBounds {
            light: LightId(1),
            reason: LightBoundsError::Box,
        };
        assert_eq!(bad(Vec3::X * x), Err(error), "{x}");
    }
}

/// Shuffled lamps on a line: the tree must be as good as for sorted ones.
#[test]
fn collinear_lights_are_sorted_by_the_tree() {
    let shuffled = build((0..256).map(|i| lamp(Vec3::new((i * 101 % 256) as f32, 0.0, 1.0))));
    let ctx = LightSampleContext::surface(Vec3::X * 100.0, Vec3::Z, Vec3::Z);
    let pmfs = lawful_pmfs(&shuffled, &ctx);
    let variance = relative_variance(&pmfs, |i| {
        let d = (i * 101 % 256) as f64 - 100.0;
        (d * d + 1.0).powi(-2)
    });
    assert!(variance < 0.5, "{variance}");
}

/// Of the estimator `f / pmf`.
fn relative_variance(pmfs: &[f32], f: impl Fn(usize) -> f64) -> f64 {
    let total: f64 = (0..pmfs.len()).map(&f).sum();
    let square = |(i, &p): (usize, &f32)| f(i) * f(i) / f64::from(p);
    pmfs.iter().enumerate().map(square).sum::<f64>() / (total * total) - 1.0
}

#[test]
fn every_random_number_and_every_light_has_a_result() {
    let tree = build([point_light(Vec3::ZERO), point_light(Vec3::X)]);
    let ctx = LightSampleContext::medium(Vec3::Z);
    for u in [0, u64::MAX] {
        assert!(tree.sample(&ctx, u).is_some(), "{u}");
    }
    assert_eq!(tree.pmf(&ctx, LightId(2)), 0.0, "unknown");
    assert_eq!(tree.pmf(&ctx, LightId(u32::MAX)), 0.0, "unknown");
    let empty = build([]);
    assert_eq!(empty.sample(&ctx, 1 << 63), None, "empty");
}

#[test]
fn borrowed_parts_are_checked() {
    let tree = build((0..9).map(|i| point_light(Vec3::X * i as f32)));
    let view = tree.view();
    let (nodes, trails, bounds) = (view.nodes(), view.trails(), view.bounds());
    assert!(
        ReferenceLightBvhRef::new(nodes, trails, bounds).is_ok(),
        "its own"
    );
    assert!(
        ReferenceLightBvhRef::new(&nodes[..16], trails, bounds).is_err(),
        "a node is missing"
    );
    assert!(
        ReferenceLightBvhRef::new(nodes, &trails[..8], bounds).is_err(),
        "a trail is missing"
    );
    let mut swapped = trails.to_vec();
    swapped.swap(0, 8);
    assert!(
        ReferenceLightBvhRef::new(nodes, &swapped, bounds).is_err(),
        "a trail leads elsewhere"
    );
    assert!(ReferenceLightBvhRef::new(&[], &[], bounds).is_ok(), "empty");
    let mut more = trails.to_vec();
    more.push(trails[8]);
    assert!(
        ReferenceLightBvhRef::new(nodes, &more, bounds).is_err(),
        "a trail of no light"
    );
    let of = |index: usize| *nodes[index].bounds();
    let leaf = |id: u32| ReferenceNode::leaf(of(0), LightId(id));
    for (nodes, what) in [
        (vec![leaf(0), leaf(1)], "a node behind the tree"),
        (
            vec![ReferenceNode::interior(of(0), 1), leaf(0), leaf(1)],
            "a second child that is the first",
        ),
        (
            vec![ReferenceNode::interior(of(0), 1); 40],
            "more levels than a trail has",
        ),
    ] {
        let trails = [BitTrail::ROOT, BitTrail::ROOT];
        let first = BitTrail::ROOT.then(Side::First).expect("one level");
        for trails in [trails, [first; 2]] {
            assert!(
                ReferenceLightBvhRef::new(&nodes, &trails, bounds).is_err(),
                "{what}"
            );
        }
    }
}
