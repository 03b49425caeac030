use light_math::float;

use super::importance::Receiver;
use super::node::{BOTH_SIDES, WIDTH, WideNode, decode_power};

/// A child of a node as a receiver sees it.
///
/// Lengths are in a unit near the distance to the node or its extent, whichever is larger: no power of a length overflows or vanishes,
/// at any scale.
#[derive(Clone, Copy, Debug)]
pub struct Lane {
    /// From the receiver to the mean position.
    pub mean: [f32; 3],
    /// Half extents of a box about that position that holds all emitting points.
    pub extent: [f32; 3],
    /// Length of `mean`, kept above 0.
    pub dist: f32,
    /// Its square.
    pub dist_sq: f32,
    /// Mean emission axis.
    pub axis: [f32; 3],
    /// Mean emission offset: the child emits about `power * max(0, dot(axis, w) - offset)` toward a unit vector `w`.
    pub offset: f32,
    /// Root mean square deviation of axis and offset.
    pub spread: f32,
    /// Whether no light of the child emits beyond its axis and offset: where these say nothing is emitted, nothing is.
    pub sharp: bool,
    /// Whether the child emits alike to both sides.
    pub both_sides: bool,
    /// Scale of the emission; 0 for an empty slot.
    pub power: f32,
}

/// What the children of a node are worth to a receiver.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights {
    /// One number a child: 0 only if it cannot contribute.
    pub(crate) lanes: [f32; WIDTH],
    /// One over the unit of length that the weights are in.
    pub(crate) inv_unit: f32,
}

impl Weights {
    /// What the children of `node` are worth to `receiver`, in the vectors of the build's target.
    #[inline(always)]
    pub(crate) fn narrow<R: Receiver>(node: &WideNode, receiver: &R) -> Self {
        let mut lanes = [0.0; WIDTH];
        let inv_unit = for_each_lane(node, receiver, |k, lane, inv_unit| {
            lanes[k] = receiver.weigh(lane, inv_unit);
        });
        Self { lanes, inv_unit }
    }

    /// The same, and for each child how rough its estimate is: 0 for a point far away, 1 for a box around the receiver.
    #[inline(always)]
    pub(crate) fn narrow_with_roughness<R: Receiver>(
        node: &WideNode,
        receiver: &R,
    ) -> (Self, [f32; WIDTH]) {
        let mut lanes = [0.0; WIDTH];
        let mut roughness = [0.0; WIDTH];
        let inv_unit = for_each_lane(node, receiver, |k, lane, inv_unit| {
            lanes[k] = receiver.weigh(lane, inv_unit);
            let [hx, hy, hz] = lane.extent;
            let extent_sq = hx * hx + hy * hy + hz * hz;
            roughness[k] = extent_sq / (extent_sq + lane.dist_sq);
        });
        (Self { lanes, inv_unit }, roughness)
    }

    /// The sum of the weights, always added up in the same order.
    #[inline(always)]
    pub(crate) fn total(&self) -> f32 {
        let w = &self.lanes;
        ((w[0] + w[4]) + (w[2] + w[6])) + ((w[1] + w[5]) + (w[3] + w[7]))
    }
}

/// Calls `each` with every child as `receiver` sees it, and one over the unit of length; returns the latter.
///
/// Written so that the compiler computes all children together: no branches, and nothing that depends on another child.
#[inline(always)]
fn for_each_lane<R: Receiver>(
    node: &WideNode,
    receiver: &R,
    mut each: impl FnMut(usize, &Lane, f32),
) -> f32 {
    let p = receiver.position();
    let [ox, oy, oz] = [
        node.origin[0] - p.x,
        node.origin[1] - p.y,
        node.origin[2] - p.z,
    ];
    let away = ox.abs() + oy.abs() + oz.abs() + receiver.reach();
    let extent = 256.0 * node.scale;
    let inv_unit = inverse_power_of_two(if away > extent { away } else { extent });
    let scale = node.scale * inv_unit;
    let [ox, oy, oz] = [ox * inv_unit, oy * inv_unit, oz * inv_unit];
    // A light at the point itself is taken to be a hundredth of a code away.
    let min_dist_sq = 1e-4 * scale * scale;

    for k in 0..WIDTH {
        let mean = [
            ox + scale * f32::from(node.mean[0][k]),
            oy + scale * f32::from(node.mean[1][k]),
            oz + scale * f32::from(node.mean[2][k]),
        ];
        let dist_sq = mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2] + min_dist_sq;
        let both_sides = node.offset[k] == BOTH_SIDES;
        let lane = Lane {
            mean,
            extent: [
                scale * f32::from(node.extent[0][k]),
                scale * f32::from(node.extent[1][k]),
                scale * f32::from(node.extent[2][k]),
            ],
            dist: float::sqrt(dist_sq),
            dist_sq,
            axis: [
                f32::from(node.axis[0][k]),
                f32::from(node.axis[1][k]),
                f32::from(node.axis[2][k]),
            ],
            offset: if both_sides {
                0.0
            } else {
                f32::from(node.offset[k])
            },
            spread: f32::from(node.spread[k].max(1)),
            sharp: node.spread[k] == 0,
            both_sides,
            power: decode_power(node.power[k]),
        };
        each(k, &lane, inv_unit);
    }
    inv_unit
}

/// One over the largest power of two that is not above `x`, which is below 2^127.
#[inline(always)]
fn inverse_power_of_two(x: f32) -> f32 {
    let exponent = x.to_bits() & 0x7f80_0000;
    f32::from_bits((254 << 23) - exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_powers_of_two_are_exact() {
        for (x, inv) in [
            (1.0, 1.0),
            (1.99, 1.0),
            (2.0, 0.5),
            (0.3, 4.0),
            (1e36, 1.504_632_8e-36),
        ] {
            assert_eq!(inverse_power_of_two(x), inv, "{x}");
        }
        assert!(inverse_power_of_two(0.0).is_finite(), "zero");
    }
}
