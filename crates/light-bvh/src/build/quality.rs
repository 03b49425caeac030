use light_math::float;
use light_math::glam::Vec3;

use crate::node::spread_code::{RAMP_BY_SPREAD, SpreadCode};
use crate::node::wide_node::{BOTH_SIDES, WIDTH, WideNode, decode_power};

/// [`LightBvh::degradation`](crate::LightBvh::degradation) of the tree of `nodes`.
pub(crate) fn degradation(nodes: &[WideNode]) -> f64 {
    let mut steps = Steps::default();
    if !nodes.is_empty() {
        spread_of(nodes, 0, &mut steps);
    }
    if steps.weight > 0.0 {
        steps.ratios / steps.weight
    } else {
        0.0
    }
}

/// All steps from a node to a child that is one.
#[derive(Default)]
struct Steps {
    ratios: f64,
    weight: f64,
}

/// What is below a node.
#[derive(Clone, Copy, Default)]
struct GroupSpread {
    /// Variance of the positions.
    variance: f64,
    spread_sq: f64,
}

/// The group below node `index`. Recursive, as deep as the tree at most.
fn spread_of(nodes: &[WideNode], index: usize, steps: &mut Steps) -> GroupSpread {
    let node = &nodes[index];
    let slots = || 0..node.children();
    let weight = |k: usize| decode_power(node.power[k]);
    let total: f32 = slots().map(weight).sum();
    if !(total > 0.0) {
        return GroupSpread::default();
    }
    let mut groups = [GroupSpread::default(); WIDTH];
    for (k, spread) in groups.iter_mut().enumerate().take(usize::from(node.inner)) {
        *spread = spread_of(nodes, node.child_base as usize + k, steps);
    }
    // Positions in codes, from the node's origin; emission in the children's common units.
    let [mut mean, mut axis] = [Vec3::ZERO; 2];
    let [mut square, mut offset, mut emission_sq] = [0.0; 3];
    let mut within = 0.0;
    for k in slots() {
        let share = weight(k) / total;
        let (p, w, o) = (position(node, k), axis_of(node, k), offset_of(node, k));
        mean += p * share;
        square += p.length_squared() * share;
        axis += w * share;
        offset += o * share;
        let spread = SpreadCode(node.spread[k]).value();
        emission_sq +=
            (w.length_squared() + o * o + (spread * spread * (1.0 / RAMP_BY_SPREAD) - 1.0)) * share;
        within += groups[k].variance * f64::from(share);
    }
    let scale = 1.0 / f64::from(node.inv_scale);
    let between = f64::from((square - mean.length_squared()).max(0.0));
    let variance = within + between * scale * scale;
    let common = (axis.length_squared() + offset * offset) / emission_sq.max(f32::MIN_POSITIVE);
    let spread_sq = spread_sq(variance, (1.0 - common).clamp(0.0, 1.0));
    if spread_sq > 0.0 {
        for (k, group) in groups.iter().enumerate().take(usize::from(node.inner)) {
            let weight = f64::from(weight(k)) * f64::from(node.gain());
            steps.ratios += weight * f64::from(ratio(group.spread_sq / spread_sq));
            steps.weight += weight;
        }
    }
    GroupSpread {
        variance,
        spread_sq,
    }
}

/// The square of what the builder minimises: see [`degradation`](crate::LightBvh::degradation). Of
/// lights of this variance of position, and of emission by a share of that of lights in all
/// directions.
pub(crate) fn spread_sq(variance: f64, disagreement: f32) -> f64 {
    let factor = 1.0 + disagreement;
    let root = float::sqrt(float::sqrt(factor));
    variance * f64::from(factor * root)
}

#[expect(clippy::cast_possible_truncation, reason = "a ratio near 1")]
fn ratio(square: f64) -> f32 {
    float::sqrt(square as f32)
}

fn position(node: &WideNode, k: usize) -> Vec3 {
    Vec3::from_array([0, 1, 2].map(|axis| f32::from(node.mean[axis][k])))
}

fn axis_of(node: &WideNode, k: usize) -> Vec3 {
    Vec3::from_array([0, 1, 2].map(|axis| f32::from(node.axis[axis][k])))
}

fn offset_of(node: &WideNode, k: usize) -> f32 {
    match node.offset[k] {
        BOTH_SIDES => 0.0,
        1.. if node.is_sheet(k) => 0.0,
        offset => f32::from(offset),
    }
}
