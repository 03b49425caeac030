//! The default tree is bounded in depth, whole, and the same every time.

use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
use light_bvh::light_bounds::{LightBounds, LightExtent, LightId, LightSampleContext};
use light_bvh::{CutDetail, CutDetailError, LightBvh, LightBvhError, LightBvhOptions, MAX_DEPTH};

use crate::support::lamp;

const MODES: [LightBvhOptions; 3] = [
    LightBvhOptions::QUALITY,
    LightBvhOptions::FAST,
    LightBvhOptions::DYNAMIC,
];

fn nasty_sets() -> Vec<Vec<LightExtent>> {
    let n = 3000;
    vec![
        (0..n).map(|_| lamp(Vec3::ONE, 1.0)).collect(),
        (0..n).map(|i| lamp(Vec3::X * i as f32, 1.0)).collect(),
        (0..n)
            .map(|i| lamp(Vec3::X * 0.5f32.powi(i % 120), 1.0))
            .collect(),
        (0..n)
            .map(|i| lamp(Vec3::splat(1e18 * (i as f32).sin()), 1.0))
            .collect(),
        (0..n)
            .map(|i| lamp(Vec3::splat(1e-20 * (i as f32).sin()), 1.0))
            .collect(),
        (0..n)
            .map(|i| lamp(Vec3::X * i as f32, 2f32.powi(i % 200 - 100)))
            .collect(),
    ]
}

#[test]
fn depth_is_bounded_and_every_light_is_in_the_tree() {
    let sets = nasty_sets();
    for (i, (lights, options)) in sets.iter().flat_map(|s| MODES.map(|o| (s, o))).enumerate() {
        let tree = LightBvh::build_with(lights, &options).expect("valid lights");
        assert!(tree.depth() <= MAX_DEPTH, "set {i}: {}", tree.depth());
        let medium = LightSampleContext::medium(Vec3::new(0.5, 0.25, -1.0));
        let sum: f64 = (0..3000)
            .map(|id| f64::from(tree.pmf(&medium, LightId(id))))
            .sum();
        assert!((sum - 1.0).abs() < 1e-4, "set {i}: {sum}");
    }
}

#[test]
fn the_same_lights_give_the_same_tree() {
    for lights in nasty_sets() {
        let build = || LightBvh::build_with(&lights, &LightBvhOptions::FAST);
        let (a, b) = (build(), build());
        let (a, b) = (a.expect("valid lights"), b.expect("valid lights"));
        assert_eq!(a.view().nodes(), b.view().nodes(), "nodes");
        assert_eq!(a.view().order(), b.view().order(), "order");
    }
}

#[test]
fn lights_beyond_reach_are_refused_by_name() {
    let lights = [lamp(Vec3::ONE, 1.0), lamp(Vec3::splat(1e37), 1.0)];
    let error = LightBvh::build(&lights).expect_err("too far");
    assert_eq!(error, LightBvhError::TooFar { light: LightId(1) }, "which");
}

#[test]
fn lights_without_power_are_not_in_the_tree() {
    let tree = LightBvh::build(&[lamp(Vec3::ONE, 0.0)]).expect("valid lights");
    let medium = LightSampleContext::medium(Vec3::ZERO);
    assert_eq!(tree.sample(&medium, 1 << 63), None, "nothing to choose");
    assert_eq!(tree.pmf(&medium, LightId(0)), 0.0, "known, but dark");
    assert_eq!(tree.view().at(&medium).irradiance(), 0.0, "no light");
}

#[test]
fn many_lights_at_one_point_along_a_line_or_in_nested_clusters_make_no_deep_tree() {
    let n = 60_000u16;
    let sets: [&dyn Fn(u16) -> Vec3; 3] = [&|_| Vec3::ONE, &|i| Vec3::X * f32::from(i), &|i| {
        Vec3::new(1.0, f32::from(i % 7), f32::from(i % 5)) * 0.125f32.powi(i32::from(i % 24))
    }];
    for (k, at) in sets.iter().enumerate() {
        let lights: Vec<LightExtent> = (0..n).map(|i| lamp(at(i), 1.0)).collect();
        for options in MODES {
            let tree = LightBvh::build_with(&lights, &options).expect("valid lights");
            assert!(tree.depth() <= MAX_DEPTH, "set {k}: {}", tree.depth());
            assert!(
                tree.bytes() < 40 * lights.len(),
                "set {k}: {} bytes",
                tree.bytes()
            );
        }
    }
}

#[test]
fn lights_far_closer_than_the_cells_of_the_whole_set_part_by_place() {
    // Two clusters of 300 lights in turn, 1e-3 apart, and a lamp so far away that a cell of the
    // whole is wider than both.
    let place = |i: u16| match i {
        600 => Vec3::splat(1e6),
        _ => Vec3::X * 1e-3 * (f32::from(i % 2) + 0.1 * f32::from(i) / 600.0),
    };
    let lights: Vec<LightExtent> = (0..601).map(|i| lamp(place(i), 1.0)).collect();
    for options in MODES {
        let tree = LightBvh::build_with(&lights, &options).expect("valid lights");
        let order = tree.view().order();
        let turns = order.windows(2).filter(|w| w[0] % 2 != w[1] % 2).count();
        assert!(turns < 8, "{options:?}: clusters mix {turns} times");
    }
}

/// Numbers of `[0, 1)` that are the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / 16_777_216.0
    }

    fn vec3(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }

    fn direction(&mut self) -> Vec3 {
        (self.vec3() - 0.5).normalize_or(Vec3::X)
    }
}

/// Every point of a surface that shines at a point by however little, and every direction within a
/// cone, has a probability above 0.
#[test]
fn importance_is_zero_only_where_no_part_of_a_light_emits() {
    let mut numbers = Numbers(5);
    let (mut given_up, mut kept) = (0, 0);
    for round in 0..3000 {
        let extent = [0.01, 0.3, 3.0][round % 3];
        let count = 1 + round % 7;
        let triangles: Vec<[Vec3; 3]> = (0..count)
            .map(|_| {
                let at = numbers.vec3();
                [0; 3].map(|_| at + (numbers.vec3() - 0.5) * extent)
            })
            .collect();
        let narrow = round % 2 == 0;
        let half_angle = 0.02 + 1.5 * numbers.next();
        let lights: Vec<LightExtent> = triangles
            .iter()
            .map(|[a, b, c]| {
                LightExtent::Bounded(LightBounds {
                    bounds: if narrow {
                        Aabb::from_point(*a)
                    } else {
                        Aabb::from_points([*a, *b, *c])
                    },
                    w: (*b - *a).cross(*c - *a).normalize_or(Vec3::Z),
                    phi: 1.0 + numbers.next(),
                    cos_theta_o: if narrow { half_angle.cos() } else { 1.0 },
                    cos_theta_e: if narrow { 1.0 } else { 0.0 },
                    two_sided: false,
                })
            })
            .collect();
        let tree = LightBvh::build(&lights).expect("valid lights");
        let (p, n) = (numbers.vec3() * 2.0 - 0.5, numbers.direction());
        let floor = LightSampleContext::surface(p, n, n);
        let pane = LightSampleContext::two_sided(p, n, n);
        for (id, ([a, b, c], light)) in (0..).map(LightId).zip(triangles.iter().zip(&lights)) {
            let w = light.bounded().expect("a triangle").w;
            let shines = |point: Vec3| {
                let to_light = point - p;
                let cos = -w.dot(to_light.normalize());
                let edge = if narrow { half_angle.cos() } else { 0.0 };
                (cos > edge + 1e-6, n.dot(to_light) > 1e-6)
            };
            let points = (0..64).map(|i| {
                let (s, t) = ((i / 8) as f32 / 7.0, (i % 8) as f32 / 7.0);
                if narrow {
                    *a
                } else {
                    *a + (*b - *a) * (s * (1.0 - t)) + (*c - *a) * t
                }
            });
            for (emits, above) in points.map(shines) {
                assert!(
                    !emits || tree.pmf(&pane, id) > 0.0,
                    "{id:?} of {lights:?} at {p}"
                );
                assert!(
                    !(emits && above) || tree.pmf(&floor, id) > 0.0,
                    "{id:?} of {lights:?} at {p}, {n}"
                );
            }
            if tree.pmf(&pane, id) > 0.0 {
                kept += 1;
            } else {
                given_up += 1;
            }
        }
    }
    assert!(given_up > kept / 10, "{given_up} given up, {kept} kept");
}

#[test]
fn a_cut_opens_no_group_without_weight() {
    for threshold in [-1.0, -f32::MIN_POSITIVE, f32::NEG_INFINITY, f32::NAN] {
        let detail = CutDetail::new(threshold);
        assert_eq!(detail, Err(CutDetailError::Threshold), "{threshold}");
    }
    for threshold in [0.0, 0.08, f32::INFINITY] {
        let detail = CutDetail::new(threshold).map(CutDetail::threshold);
        assert_eq!(detail, Ok(threshold), "{threshold}");
    }
}
