use light_math::float;
use light_math::glam::Vec3;

use super::moments::{Moments, Shape};
use super::node::{BOTH_SIDES, WIDTH, WideNode, encode_power};

/// The least scale of a node: lights closer together than this are taken as one point.
const MIN_SCALE: f32 = 1e-30;

impl WideNode {
    /// A node whose children have the given moments, at most eight; `child_base`, `light_base`, `inner` and `parent` are left to
    /// the caller.
    pub(crate) fn encode(children: &[Moments]) -> Self {
        debug_assert!(children.len() <= WIDTH, "at most eight children");
        let mut node = Self {
            count: u8::try_from(children.len()).unwrap_or(0),
            ..Self::EMPTY
        };
        node.set_frame(children);
        let units: [f32; WIDTH] = core::array::from_fn(|k| children.get(k).map_or(0.0, unit));
        let sides = |k: usize| f32::from(1 + u8::from(children[k].shape == Shape::BothSides));
        let power = |k: usize| sides(k) * children[k].power * units[k];
        let max_power = (0..children.len())
            .map(power)
            .fold(f32::MIN_POSITIVE, f32::max);
        node.gain = encode_gain(max_power);
        // What is off leaves its slot empty.
        let lit = children.iter().enumerate().filter(|(_, c)| c.power > 0.0);
        for (k, child) in lit {
            node.set_box(k, child);
            node.set_emission(k, child, units[k]);
            node.power[k] = encode_power(power(k) / max_power);
        }
        node
    }

    fn set_frame(&mut self, children: &[Moments]) {
        let lit = || children.iter().filter(|c| c.power > 0.0);
        let Some(low) = lit().map(|c| c.mean).reduce(Vec3::min) else {
            return;
        };
        let mut scale = MIN_SCALE;
        for child in lit() {
            let reach = (child.mean - low).max_element();
            let half = (child.bounds.max - child.mean).max(child.mean - child.bounds.min);
            scale = scale.max(reach / 255.0).max(half.max_element() / 253.0);
        }
        self.origin = low.to_array();
        // A little more, so that rounding cannot push a code beyond its range.
        self.inv_scale = (1.0 - 4.0 * f32::EPSILON) / scale;
    }

    /// Mean position and a box around it, both exact in double precision, so that the box holds what it must.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the range of the code; NaN cannot occur with finite bounds"
    )]
    fn set_box(&mut self, k: usize, child: &Moments) {
        let scale = 1.0 / f64::from(self.inv_scale);
        for axis in 0..3 {
            let origin = f64::from(self.origin[axis]);
            let at = (f64::from(child.mean[axis]) - origin) / scale;
            let code = (at + 0.5).clamp(0.0, 255.0) as u8;
            let decoded = origin + scale * f64::from(code);
            let above = f64::from(child.bounds.max[axis]) - decoded;
            let below = decoded - f64::from(child.bounds.min[axis]);
            let half = above.max(below) / scale;
            self.mean[axis][k] = code;
            // Truncation plus one is above, and never 0: a child without extent keeps a floor of uncertainty.
            self.extent[axis][k] = (half.clamp(0.0, 254.0) as u8).saturating_add(1);
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "float to integer casts saturate"
    )]
    fn set_emission(&mut self, k: usize, child: &Moments, unit: f32) {
        let inv_unit = 1.0 / unit;
        for axis in 0..3 {
            self.axis[axis][k] = float::round(child.axis[axis] * inv_unit) as i8;
        }
        self.offset[k] = if child.shape == Shape::BothSides {
            BOTH_SIDES
        } else {
            (float::round(child.offset * inv_unit) as i8).max(-127)
        };
        let spread = float::ceil(spread(child) * inv_unit);
        self.spread[k] = spread.clamp(1.0, 255.0) as u8;
        if child.spread_sq == 0.0 && child.shape != Shape::BothSides {
            let decoded = Vec3::from(self.axis.map(|axis| f32::from(axis[k])));
            if let Some(offset) =
                offset_below(decoded, child.axis * inv_unit, child.offset * inv_unit)
            {
                self.offset[k] = offset;
                self.spread[k] = 0;
            }
        }
    }
}

/// The code of an offset so that `dot(decoded, w)` is above it wherever `dot(axis, w)` is above `offset`, for all unit vectors `w`;
/// `None` if there is no such code.
#[expect(clippy::cast_possible_truncation, reason = "checked to be in range")]
fn offset_below(decoded: Vec3, axis: Vec3, offset: f32) -> Option<i8> {
    /// What is left to round-off, in codes.
    const MARGIN: f32 = 0.01;
    let length = axis.length();
    let (along, aside) = if length > 0.0 {
        let along = decoded.dot(axis) / length;
        (along, (decoded - axis * (along / length)).length())
    } else {
        (0.0, decoded.length())
    };
    // The edge of the lit directions, seen from the exact axis, and the decoded axis' least component in it: at the edge on the far side,
    // or opposite to the decoded axis if that is lit.
    let cos = if length > 0.0 {
        (offset / length).clamp(-1.0, 1.0)
    } else {
        -1.0
    };
    let sin = float::safe_sqrt(1.0 - cos * cos);
    let least = if along * sin + aside * cos <= 0.0 {
        -float::sqrt(along * along + aside * aside)
    } else {
        along * cos - aside * sin
    };
    let code = float::floor(least - MARGIN).min(float::round(offset));
    (code >= -127.0).then_some(code as i8)
}

/// The unit of a child's axis, offset and spread: what makes the largest of them fit its code.
fn unit(child: &Moments) -> f32 {
    let axis = child.axis.abs().max_element();
    let widest = axis.max(child.offset.abs()).max(0.5 * spread(child));
    widest.max(1e-6) / 127.0
}

/// The spread that a child is given: less than the true one where narrow cones make the axes long, for few of their deviations
/// matter to one receiver. Measured: half the variance is best.
fn spread(child: &Moments) -> f32 {
    let is_narrow = child.axis.length_squared().max(child.offset * child.offset) > 1.1;
    let counted = if is_narrow { 0.5 } else { 1.0 };
    float::sqrt(counted * child.spread_sq)
}

/// The upper half of the float: always finite and above 0.
fn encode_gain(power: f32) -> u16 {
    ((power.clamp(f32::MIN_POSITIVE, 1e30).to_bits() + 0x8000) >> 16) as u16
}
