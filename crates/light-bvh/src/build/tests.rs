//! Costs of groups of lights, and how a build separates them.

use alloc::vec::Vec;
use core::f32::consts::PI;

use light_bounds::{EmissionLobe, InfiniteBounds, LightBounds, LightExtent};
use light_math::Aabb;
use light_math::glam::Vec3;

use super::binned_split::BinnedSplit;
use super::bins::{BINS, Grid};
use super::cluster::{Cluster, Sums};
use super::clustering::clusters;
use super::light_primitive::LightPrimitive;
use super::lights::phi;
use super::node_children::is_depth_limited;
use super::options::{BuildMode, DarkLights, LightBvhOptions};
use super::quality::degradation;
use super::subtree::OutputSlice;
use crate::node::light_emission::Shape;
use crate::node::moments::Moments;
use crate::node::spread_code::{RAMP_BY_SPREAD, SpreadCode};
use crate::node::wide_node::{BOTH_SIDES, MAX_DEPTH, WideNode, encode_power};

fn cluster(center: Vec3, power: f32, axis: Vec3) -> Cluster {
    Cluster {
        center,
        power,
        axis,
        axis_sq: axis.length_squared(),
        variance: 0.0,
        first: 0,
        lights: 1,
    }
}

/// Of unequal powers, the sum of which is not 1.
fn five() -> [Cluster; 5] {
    [
        cluster(Vec3::new(1.0, 2.0, 3.0), 0.5, Vec3::Z),
        cluster(Vec3::new(-1.0, 2.5, 3.5), 0.25, Vec3::X),
        cluster(Vec3::new(0.5, -2.0, 4.0), 1.0, Vec3::new(0.0, 2.0, 0.0)),
        cluster(Vec3::new(2.0, 1.0, 2.0), 2.0, Vec3::new(0.6, 0.0, 0.8)),
        cluster(Vec3::new(1.5, 0.0, 2.5), 1.5, Vec3::NEG_Z),
    ]
}

/// Mean of what clusters have, weighted by power.
fn mean(clusters: &[Cluster], of: impl Fn(&Cluster) -> f64) -> f64 {
    let power = |c: &Cluster| f64::from(c.power);
    let sum: f64 = clusters.iter().map(|c| power(c) * of(c)).sum();
    sum / clusters.iter().map(power).sum::<f64>()
}

/// The variance of the positions and that of the axes, by their definition.
fn variances(clusters: &[Cluster]) -> [f64; 2] {
    [|c: &Cluster| c.center, |c: &Cluster| c.axis].map(|of| {
        let of_axis = |i: usize| {
            let x = |c: &Cluster| f64::from(of(c)[i]);
            let middle = mean(clusters, x);
            mean(clusters, |c| (x(c) - middle) * (x(c) - middle))
        };
        (0..3).map(of_axis).sum()
    })
}

fn assert_near(found: f32, expected: f64, what: &str) {
    let near = (f64::from(found) - expected).abs() <= 1e-5 * expected.abs().max(1.0);
    assert!(near, "{what}: {found}, {expected}");
}

#[test]
fn a_cluster_has_the_means_of_its_parts() {
    let parts = five();
    let all = Cluster::join(parts);
    assert_eq!(Cluster::join([]).lights, 0, "of no parts");
    assert_near(all.power, 5.25, "power");
    for i in 0..3 {
        assert_near(
            all.center[i],
            mean(&parts, |c| c.center[i].into()),
            "center",
        );
        assert_near(all.axis[i], mean(&parts, |c| c.axis[i].into()), "axis");
    }
    assert_near(
        all.axis_sq,
        mean(&parts, |c| c.axis_sq.into()),
        "squared axis",
    );
    let [variance, _] = variances(&parts);
    assert_near(all.variance, variance, "variance");
    assert_eq!(all.lights, 5, "lights");
}

#[test]
fn a_group_costs_power_times_deviation() {
    let parts = five();
    let sums = parts.iter().map(|c| Sums::of(c, c.center));
    let cost = sums.fold(Sums::default(), |all, s| all.plus(&s)).cost();
    let [position, axis] = variances(&parts);
    let expected = 5.25 * (position * (1.0 + axis).powf(1.25)).sqrt();
    assert_near(cost, expected, "cost");
}

#[test]
fn lights_at_the_upper_end_fall_into_the_last_bin() {
    let grid = Grid::new(&Aabb::new(Vec3::ZERO, Vec3::ONE));
    for (x, bin) in [
        (0.0, 0),
        (0.49, 3),
        (0.51, 4),
        (1.0, BINS - 1),
        (1.5, BINS - 1),
    ] {
        let cluster = cluster(Vec3::splat(x), 1.0, Vec3::Z);
        assert_eq!(grid.along(&cluster, 0), bin, "{x}");
        assert_eq!(grid.position(&cluster), [bin; 3], "{x}");
    }
}

/// The intensity of a beam counts as if it were everywhere.
#[test]
fn a_beam_has_the_power_of_its_peak() {
    let bounds = LightBounds {
        bounds: Aabb::from_point(Vec3::ZERO),
        w: Vec3::Z,
        phi: 2.0,
        cos_theta_o: 1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    };
    let of = |mean| {
        let lobe = EmissionLobe {
            power: 2.0,
            mean,
            spread: 0.0,
        };
        phi(&LightExtent::Lobe(bounds, lobe))
    };
    assert_near(of(Vec3::ZERO), 2.0, "all around");
    // The peak is the power over pi times 3 (1 - 3/4).
    let peak = 2.0 / (PI * 0.75);
    assert_near(of(0.75 * Vec3::Z), (4.0 * PI * peak).into(), "a beam");
    assert_eq!(phi(&LightExtent::Bounded(bounds)), 2.0, "no lobe");
    let sky = LightExtent::Infinite(InfiniteBounds::uniform(2.0));
    assert_eq!(phi(&sky), 0.0, "nowhere");
    assert_eq!(Moments::of_light(&sky, 1.0).power, 0.0, "nothing to hold");
}

/// A lobe that ends at a cosine of less than -1/2 does not count as a spot.
#[test]
fn spots_end_within_two_thirds_of_the_sphere() {
    let bounds = LightBounds {
        bounds: Aabb::from_point(Vec3::ZERO),
        w: Vec3::Z,
        phi: 1.0,
        cos_theta_o: 1.0,
        cos_theta_e: -1.0,
        two_sided: false,
    };
    for (length, is_spot) in [(0.2, false), (0.45, false), (0.55, true), (0.9, true)] {
        let lobe = EmissionLobe {
            power: 1.0,
            mean: Vec3::Z * length,
            spread: 0.1,
        };
        let moments = Moments::of_light(&LightExtent::Lobe(bounds, lobe), 1.0);
        assert_eq!(moments.shape != Shape::Mixed, is_spot, "{length}");
    }
}

/// Two levels for lights at half the distance each, which planes take off a few at a time.
#[test]
fn where_levels_run_out_groups_are_halved() {
    let at = |light: u32| Vec3::X * f32::from_bits((127 - light / 2) << 23);
    let primitives: Vec<LightPrimitive> = (0..200)
        .map(|light| LightPrimitive {
            center: at(light),
            power: 0.005,
            light,
            axis: Vec3::Z,
        })
        .collect();
    let ends: Vec<u32> = (1..=200).collect();
    let mut clusters = clusters(&ends, &primitives);
    let mut order = [u32::MAX; 200];
    let output = OutputSlice {
        order: &mut order,
        depth: MAX_DEPTH - 2,
    };
    let topology = output.build_serial(BinnedSplit::new(&mut clusters, &primitives));
    let (root, rest) = topology.0.split_first().expect("a root");
    assert_eq!(rest.len(), usize::from(root.inner), "two levels");
    assert!(rest.iter().all(|node| node.inner == 0), "lights alone");
    order.sort_unstable();
    assert!(order.into_iter().eq(0..200), "each light once");
}

/// Where all levels below would have to be full: of sixteen children, and of at most seven levels,
/// so that lights are 28 bits.
#[test]
fn few_levels_limit_many_lights() {
    for (levels, most) in [(1, 1), (2, 16), (3, 256), (7, 1 << 24)] {
        assert!(!is_depth_limited(most, levels), "{most} in {levels}");
        assert!(is_depth_limited(most + 1, levels), "one more in {levels}");
    }
    assert!(
        !is_depth_limited(usize::MAX, 8),
        "more than lights there are"
    );
}

#[test]
fn presets_are_what_they_are_for() {
    let presets = [
        (
            LightBvhOptions::QUALITY,
            BuildMode::Binned,
            DarkLights::LeftOut,
        ),
        (
            LightBvhOptions::FAST,
            BuildMode::Morton,
            DarkLights::LeftOut,
        ),
        (
            LightBvhOptions::DYNAMIC,
            BuildMode::Binned,
            DarkLights::Kept,
        ),
    ];
    for (options, mode, dark) in presets {
        assert_eq!(
            options,
            LightBvhOptions { mode, dark },
            "{mode:?}, {dark:?}"
        );
    }
}

/// Of one step, from two lights that differ in all to two that lie apart alone.
#[test]
fn degradation_is_the_ratio_of_the_spreads() {
    let half = encode_power(0.5);
    let gain = u16::try_from(0.5f32.to_bits() >> 16).expect("upper half");
    let mut root = WideNode {
        child_base: 1,
        count: 2,
        inner: 1,
        gain,
        inv_scale: 1.0,
        ..WideNode::EMPTY
    };
    root.power[..2].fill(half);
    root.mean[0][1] = 200;
    root.axis[0][0] = 100;
    root.axis[1][1] = 100;
    (root.offset[0], root.offset[1]) = (20, 60);
    let spreads = [5.2, 15.6].map(|x| SpreadCode::new(x, false, true));
    root.spread[..2].copy_from_slice(&spreads.map(|code| code.0));
    let deviation_sq = spreads.map(|code| {
        let spread = f64::from(code.value());
        spread * spread / f64::from(RAMP_BY_SPREAD) - 1.0
    });
    let mut child = WideNode {
        count: 2,
        gain,
        inv_scale: 2.0,
        ..WideNode::EMPTY
    };
    child.power[..2].fill(half);
    child.mean[1][1] = 100;
    child.offset[..2].fill(50);
    // Half of 100 codes at two a unit.
    let below = 25.0f64 * 25.0;
    let variance = 100.0 * 100.0 + 0.5 * below;
    // Axes (50, 50, 0) and offset 40 on average.
    let common = f64::from(2 * 50 * 50 + 40 * 40);
    let [a, b] = deviation_sq;
    let emission_sq = 0.5 * (10_000.0 + 400.0 + a) + 0.5 * (10_000.0 + 3600.0 + b);
    let disagreement = 2.0 - common / emission_sq;
    let expected = (below / (variance * disagreement.powf(1.25))).sqrt();
    let found = degradation(&[root, child]);
    assert!((found - expected).abs() < 1e-6, "{found}, {expected}");
    let mut both = root;
    (both.offset[0], both.offset[1]) = (0, 60);
    let one_sided = degradation(&[both, child]);
    both.offset[0] = BOTH_SIDES;
    assert_eq!(degradation(&[both, child]), one_sided, "no side");
    assert_eq!(degradation(&[child]), 0.0, "no step");
    assert_eq!(degradation(&Vec::new()), 0.0, "no node");
}
