use light_math::float;

use crate::lane_math::{larger, low_byte, nearest, smaller};
use crate::node::children_soa::ChildrenSoa;
use crate::node::wide_node::{BOTH_SIDES, WIDTH, WideNode};

impl WideNode {
    /// Axes, offsets and spreads; returns their units.
    #[inline(always)]
    pub(crate) fn set_emission(&mut self, children: &ChildrenSoa) -> [f32; WIDTH] {
        let (mut units, mut spreads) = ([0.0; WIDTH], [0.0; WIDTH]);
        for k in 0..WIDTH {
            let [x, y, z] = [
                children.axis[0][k],
                children.axis[1][k],
                children.axis[2][k],
            ];
            let offset = children.offset[k];
            // Less than the true spread where narrow cones make the axes long, for few of their
            // deviations matter to one receiver. Measured: half the variance is best.
            let is_narrow = larger(x * x + y * y + z * z, offset * offset) > 1.1;
            let counted = if is_narrow { 0.5 } else { 1.0 };
            spreads[k] = float::sqrt(counted * children.spread_sq[k]);
            // What makes the largest of them fit its code.
            let widest = larger(larger(x.abs(), y.abs()), larger(z.abs(), offset.abs()));
            units[k] = larger(larger(widest, 0.5 * spreads[k]), 1e-6) * (1.0 / 127.0);
        }
        let inv_units = units.map(|unit| 1.0 / unit);
        let mut axes = [[0.0; WIDTH]; 3];
        for (axes, exact) in axes.iter_mut().zip(&children.axis) {
            for k in 0..WIDTH {
                axes[k] = nearest(exact[k] * inv_units[k]);
            }
        }
        let lengths = lengths(&axes);
        let mut offsets = [0.0; WIDTH];
        for k in 0..WIDTH {
            let exact = [
                children.axis[0][k] * inv_units[k],
                children.axis[1][k] * inv_units[k],
                children.axis[2][k] * inv_units[k],
            ];
            let decoded = [axes[0][k], axes[1][k], axes[2][k]];
            let offset = children.offset[k] * inv_units[k];
            let below = offset_below(decoded, lengths[k], exact, offset);
            // Only lights that are all alike have no spread.
            let sharp =
                (children.spread_sq[k] == 0.0) & (below >= -127.0) & !children.both_sides[k];
            offsets[k] = if sharp { below } else { nearest(offset) };
            let spread = larger(nearest(spreads[k] * inv_units[k] + 0.5), 1.0);
            spreads[k] = if sharp { 0.0 } else { spread };
        }
        for k in 0..WIDTH {
            let (code, both_sides) = (
                low_byte(larger(offsets[k], -127.0)) as i8,
                children.both_sides[k],
            );
            self.offset[k] = if both_sides { BOTH_SIDES } else { code };
            self.spread[k] = low_byte(spreads[k]);
        }
        for (codes, axis) in self.axis.iter_mut().zip(&axes) {
            for k in 0..WIDTH {
                codes[k] = low_byte(axis[k]) as i8;
            }
        }
        units
    }
}

#[inline(always)]
fn lengths([x, y, z]: &[[f32; WIDTH]; 3]) -> [f32; WIDTH] {
    core::array::from_fn(|k| float::sqrt(x[k] * x[k] + y[k] * y[k] + z[k] * z[k]))
}

/// The code of an offset so that `dot(decoded, w)` is above it wherever `dot(axis, w)` is above
/// `offset`, for all unit vectors `w`; below -127 if there is no such code. `length` is that of the
/// decoded axis.
#[inline(always)]
fn offset_below(decoded: [f32; 3], length: f32, axis: [f32; 3], offset: f32) -> f32 {
    /// What is left to round-off, in codes: less than 0.0005 of it here, 0.0012 because a light's
    /// axis may be too short by 5e-6, and less than 0.001 where a receiver computes the same
    /// product and its distance, in single precision from numbers of at most 220.
    const MARGIN: f32 = 0.01;
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let length_sq = dot(axis, axis);
    let inv_length = 1.0 / float::sqrt(larger(length_sq, f32::MIN_POSITIVE));
    let along = dot(decoded, axis) * inv_length;
    let t = along * inv_length;
    let aside = [
        decoded[0] - axis[0] * t,
        decoded[1] - axis[1] * t,
        decoded[2] - axis[2] * t,
    ];
    let aside = float::sqrt(dot(aside, aside));
    // The edge of the lit directions, seen from the exact axis, and the decoded axis' least
    // component in it: at the edge on the far side, or opposite to the decoded axis if that is lit.
    let cos = smaller(larger(offset * inv_length, -1.0), 1.0);
    let cos = if length_sq > 0.0 { cos } else { -1.0 };
    let sin = float::sqrt(larger(1.0 - cos * cos, 0.0));
    let is_lit = along * sin + aside * cos <= 0.0;
    let least = if is_lit {
        -length
    } else {
        along * cos - aside * sin
    };
    smaller(nearest(least - (0.5 + MARGIN)), nearest(offset))
}
