use light_math::float;

use crate::lane_math::{larger, low_byte, nearest, smaller};
use crate::node::children_soa::ChildrenSoa;
use crate::node::spread_code::{RAMP_BY_SPREAD, SpreadCode};
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
            spreads[k] = float::sqrt(children.spread_sq[k]);
            // What makes the largest of them fit its code.
            let widest = larger(larger(x.abs(), y.abs()), larger(z.abs(), offset.abs()));
            let unit = larger(larger(widest, 0.5 * spreads[k]), 1e-6) * (1.0 / 127.0);
            units[k] = if children.is_step[k] {
                1.0 / 127.0
            } else {
                unit
            };
        }
        let inv_units = units.map(|unit| 1.0 / unit);
        let mut axes = [[0.0; WIDTH]; 3];
        for (axes, exact) in axes.iter_mut().zip(&children.axis) {
            for k in 0..WIDTH {
                axes[k] = nearest(exact[k] * inv_units[k]);
            }
        }
        let lengths = lengths(&axes);
        let (mut offsets, mut is_soft) = ([0.0; WIDTH], [false; WIDTH]);
        for k in 0..WIDTH {
            let exact = [
                children.axis[0][k] * inv_units[k],
                children.axis[1][k] * inv_units[k],
                children.axis[2][k] * inv_units[k],
            ];
            let decoded = [axes[0][k], axes[1][k], axes[2][k]];
            let offset = children.offset[k] * inv_units[k];
            let below = offset_below(decoded, lengths[k], exact, offset);
            let is_step = children.is_step[k];
            // Only flat lights have no spread.
            let is_flat = (children.spread_sq[k] == 0.0) & (below >= -127.0) & !is_step;
            let is_sharp = is_flat & !children.both_sides[k];
            offsets[k] = if is_sharp { below } else { nearest(offset) };
            is_soft[k] = children.is_mean[k] | !(is_flat | is_step);
            // In codes of the axis, squared.
            let spread_sq = (spreads[k] * inv_units[k]) * (spreads[k] * inv_units[k]);
            let error_sq = step_error_sq(decoded, exact, offsets[k] - offset, children.offset[k]);
            let ramp = RAMP_BY_SPREAD * (1.0 + spread_sq);
            let step = spread_sq + error_sq;
            spreads[k] = float::sqrt(if is_step { step } else { ramp });
        }
        for k in 0..WIDTH {
            let (code, both_sides) = (
                low_byte(larger(offsets[k], -127.0)) as i8,
                children.both_sides[k],
            );
            self.offset[k] = if both_sides { BOTH_SIDES } else { code };
            self.spread[k] = SpreadCode::new(spreads[k], children.is_step[k], is_soft[k]).0;
        }
        for (codes, axis) in self.axis.iter_mut().zip(&axes) {
            for k in 0..WIDTH {
                codes[k] = low_byte(axis[k]) as i8;
            }
        }
        units
    }
}

/// The squared error of the code of a step, in codes: of axis less offset along the axis, and of
/// the axis across it, of which the edge of the cone sees the sine.
#[inline(always)]
fn step_error_sq(decoded: [f32; 3], exact: [f32; 3], offset_error: f32, cos: f32) -> f32 {
    let error = [
        decoded[0] - exact[0],
        decoded[1] - exact[1],
        decoded[2] - exact[2],
    ];
    let inv_length = 1.0 / float::sqrt(larger(dot(exact, exact), 1.0));
    let along = dot(error, exact) * inv_length;
    let aside_sq = larger(dot(error, error) - along * along, 0.0);
    let forward = along - offset_error;
    let sin_sq = larger(1.0 - cos * cos, 0.0);
    forward * forward + 0.5 * aside_sq * sin_sq
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
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
