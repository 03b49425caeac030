//! Cosines and boxes in few bits, rounded conservatively: the decoded bounds contain the original.
//!
//! This holds for the decoded floats, not just for exact numbers: an encoder whose code decodes to
//! the wrong side takes the next one. In the cases where plain rounding is on
//! the right side the codes are those of `[PBRT4]`, section 12.6.3.

use glam::Vec3;

use crate::Aabb;
use crate::float::ceil;

/// The largest 15-bit code of a cosine.
pub const MAX_COS: u16 = 32767;

/// The 15-bit code of a cosine in `[-1, 1]`: one that decodes to it or to less, so to the same or a
/// wider angle.
///
/// At most `2 / 32767` is lost, a little more when plain rounding had to be corrected. Values
/// outside are clamped; NaN gives 0, which represents -1, all directions.
#[inline]
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "in [0, 32767]; the conversion truncates and sends NaN to 0"
)]
pub fn encode_cos(cos_theta: f32) -> u16 {
    let c = cos_theta.clamp(-1.0, 1.0);
    let q = (32767.0 * (0.5 * (c + 1.0))) as u16;
    // Round-off can lift a code by one, never code 0: that decodes to -1.
    q - u16::from(decode_cos(q) > c)
}

/// The cosine that the 15-bit code `q` represents, in `[-1, 1]`; larger codes count as [`MAX_COS`].
#[inline]
#[must_use]
pub fn decode_cos(q: u16) -> f32 {
    2.0 * (f32::from(q.min(MAX_COS)) / 32767.0) - 1.0
}

/// A box as 2 x 3 fractions of an enclosing box, 12 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(C)]
pub struct QuantizedBox {
    /// Lower corner in 65535ths of the enclosing box, rounded down.
    pub min: [u16; 3],
    /// Upper corner in 65535ths of the enclosing box, rounded up; 0 on an axis where that box is
    /// flat.
    pub max: [u16; 3],
}

impl QuantizedBox {
    /// The code of `bounds` within `enclosing`: what it decodes to contains `bounds`.
    ///
    /// Both boxes are finite, and `enclosing` contains `bounds`; what sticks out is cut off, NaN
    /// counts as the enclosing box's corner.
    #[must_use]
    pub fn encode(bounds: &Aabb, enclosing: &Aabb) -> Self {
        let (a, b) = (enclosing.min.to_array(), enclosing.max.to_array());
        let (min, max) = (bounds.min.to_array(), bounds.max.to_array());
        Self {
            min: core::array::from_fn(|i| encode_lower(min[i], a[i], b[i])),
            max: core::array::from_fn(|i| encode_upper(max[i], a[i], b[i])),
        }
    }

    /// The box within `enclosing` that the code represents.
    #[inline]
    #[must_use]
    pub fn decode(&self, enclosing: &Aabb) -> Aabb {
        Aabb {
            min: decode_corner(self.min, enclosing),
            max: decode_corner(self.max, enclosing),
        }
    }
}

#[inline]
fn decode_corner(q: [u16; 3], enclosing: &Aabb) -> Vec3 {
    let t = Vec3::new(f32::from(q[0]), f32::from(q[1]), f32::from(q[2])) / 65535.0;
    enclosing.min * (1.0 - t) + enclosing.max * t
}

/// The same operations as [`decode_corner`] on one axis.
#[inline]
fn decode_axis(q: u16, a: f32, b: f32) -> f32 {
    let t = f32::from(q) / 65535.0;
    a * (1.0 - t) + b * t
}

/// Where `c` lies from `a` to `b`, in 65535ths; 0 for an axis of no length. Halves, so that no
/// difference overflows.
#[inline]
fn fraction(c: f32, a: f32, b: f32) -> f32 {
    let length = 0.5 * b - 0.5 * a;
    if !(length > 0.0) {
        return 0.0;
    }
    65535.0 * ((0.5 * c - 0.5 * a) / length).clamp(0.0, 1.0)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "in [0, 65535]; the conversion truncates and sends NaN to 0"
)]
fn encode_lower(c: f32, a: f32, b: f32) -> u16 {
    let mut q = fraction(c, a, b) as u16;
    // Far from the origin many codes decode to one float: ever longer steps, to 0 at the latest,
    // which is `a` itself.
    let mut step = 1;
    while q > 0 && decode_axis(q, a, b) > c {
        q = q.saturating_sub(step);
        step = step.saturating_mul(2);
    }
    q
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "in [0, 65535] or NaN, which means the far corner"
)]
fn encode_upper(c: f32, a: f32, b: f32) -> u16 {
    if a == b {
        return 0;
    }
    let f = ceil(fraction(c, a, b));
    let mut q = if f.is_nan() { u16::MAX } else { f as u16 };
    let mut step = 1;
    while q < u16::MAX && decode_axis(q, a, b) < c {
        q = q.saturating_add(step);
        step = step.saturating_mul(2);
    }
    q
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The float that many places above `c` in the order of all floats.
    #[expect(
        clippy::cast_sign_loss,
        clippy::cast_possible_wrap,
        reason = "reads the bits both ways"
    )]
    fn neighbour(c: f32, ulps: i32) -> f32 {
        let mirror = |bits: i32| if bits < 0 { i32::MIN - bits } else { bits };
        f32::from_bits(mirror(mirror(c.to_bits() as i32) + ulps) as u32)
    }

    /// Around every decoded value: codes change and roundings fail there only.
    #[test]
    fn cosines_only_widen_around_every_code() {
        for q in 0..=MAX_COS {
            let c = decode_cos(q);
            let mut below = c;
            let mut above = c;
            for _ in 0..8 {
                for c in [below, above] {
                    let c = c.clamp(-1.0, 1.0);
                    let d = decode_cos(encode_cos(c));
                    assert!(d <= c, "code {q}: {c} decodes to {d}");
                    assert!(c - d < 2.0 * 2.0 / 32767.0, "code {q}: {c} lost to {d}");
                }
                below = below.next_down();
                above = above.next_up();
            }
        }
    }

    #[test]
    fn cosine_ends() {
        assert_eq!((encode_cos(-1.0), encode_cos(1.0)), (0, MAX_COS), "ends");
        assert_eq!((decode_cos(0), decode_cos(MAX_COS)), (-1.0, 1.0), "exact");
        assert_eq!(encode_cos(f32::NAN), 0, "NaN bounds nothing");
        assert_eq!(decode_cos(u16::MAX), 1.0, "spare bit ignored");
    }

    #[test]
    fn a_box_within_itself_is_exact_and_flat_axes_are_zero() {
        let b = Aabb::new(Vec3::new(-1.0, 2.0, 5.0), Vec3::new(3.0, 2.0, 7.5));
        let q = QuantizedBox::encode(&b, &b);
        assert_eq!((q.min, q.max), ([0; 3], [65535, 0, 65535]), "codes");
        assert_eq!(q.decode(&b), b, "exact");
    }

    /// Every code of the upper and lower corner, at the decoded floats and their neighbours.
    #[test]
    fn axes_only_grow_around_every_code() {
        for (a, b) in [
            (0.0, 1.0),
            (-3.7, 11.3),
            (1e6, 1e6 + 1.0),
            (-3e38, 3e38),
            (0.0, 1e-40),
        ] {
            for q in 0..=u16::MAX {
                let d = decode_axis(q, a, b);
                for ulps in -1..=1 {
                    let c = neighbour(d, ulps).clamp(a, b);
                    let lower = decode_axis(encode_lower(c, a, b), a, b);
                    let upper = decode_axis(encode_upper(c, a, b), a, b);
                    assert!(
                        lower <= c && c <= upper,
                        "{c} in [{a}, {b}]: {lower} {upper}"
                    );
                }
            }
        }
    }

    #[test]
    fn nan_is_the_enclosing_box() {
        let outer = Aabb::new(Vec3::ZERO, Vec3::ONE);
        let nan = Aabb {
            min: Vec3::NAN,
            max: Vec3::NAN,
        };
        assert_eq!(
            QuantizedBox::encode(&nan, &outer).decode(&outer),
            outer,
            "all of it"
        );
    }

    proptest! {
        /// Any finite floats: ordinary ones, tiny, huge, and narrow boxes far from the origin.
        #[test]
        fn decoded_boxes_contain_the_original(
            c in prop::array::uniform4(prop_oneof![
                -1e3f32..1e3, -1e-30f32..1e-30, -3e38f32..3e38, 1e6f32..1.00001e6, any::<f32>(),
            ]),
        ) {
            prop_assume!(c.iter().all(|c| c.is_finite()));
            let mut c = c;
            c.sort_by(f32::total_cmp);
            let outer = Aabb { min: Vec3::splat(c[0]), max: Vec3::splat(c[3]) };
            let inner = Aabb { min: Vec3::splat(c[1]), max: Vec3::splat(c[2]) };
            let decoded = QuantizedBox::encode(&inner, &outer).decode(&outer);
            prop_assert!(decoded.contains_box(&inner), "{:?} in {:?}: {:?}", inner, outer, decoded);
            prop_assert!(outer.contains_box(&decoded), "{:?} outside of {:?}", decoded, outer);
        }
    }
}
