//! Unit vectors on the octahedron `|x| + |y| + |z| = 1`, unfolded to a square.

use glam::{Vec2, Vec3};

use crate::float::sqrt;

/// A unit vector in 4 bytes: a position on the octahedron `|x| + |y| + |z| = 1`, unfolded to a
/// square.
///
/// Two 16-bit coordinates in one word, `x` in the low half. Every word decodes to a unit vector.
///
/// # The error bound
/// Let `h = 1 / 65535`, half the distance of two codes on `[-1, 1]`. Rounding moves a point of the
/// square by at most `h` along each axis. The square is folded onto the octahedron without a tear,
/// and on each face a step `(dx, dy)` is the step `(dx, dy, -dx - dy)` up to signs and order, at
/// most `sqrt(6) h` long; a step that crosses an edge is a chain of such steps. Every point of the
/// octahedron is at least `1 / sqrt(3)` from its centre, so the direction turns by at most
/// `sqrt(6) h * sqrt(3) = sqrt(18) h < 6.48e-5`. The float operations on the way move the point by
/// at most 9 units of `2^-24` an axis before and after, the normalisation the vector by 20 more:
/// together below `4e-6`. `cargo xtask exhaustive` compares every code with the corners of its
/// cell, in double precision.
///
/// # Source
/// `[Cigolle2014]`, section 3.3; rounding as in `[PBRT4]`, section 3.8.3.
#[doc(alias = "Octahedral16x2")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(transparent)]
pub struct OctahedralVector(u32);

impl OctahedralVector {
    /// No unit vector differs from its decoded code by more than this angle, in radians.
    pub const MAX_ANGULAR_ERROR: f32 = 6.9e-5;

    /// The code of the direction of `v`, which need not have unit length.
    ///
    /// The zero vector and vectors with NaN have codes too, of no particular direction.
    #[inline]
    #[must_use]
    pub fn encode(v: Vec3) -> Self {
        let Vec2 { x, y } = to_square(v);
        Self(quantize(x) | quantize(y) << 16)
    }

    /// The unit vector of the code, up to 2 units in the last place of its length.
    #[inline]
    #[must_use]
    pub fn decode(self) -> Vec3 {
        let x = dequantize(self.0 & 0xFFFF);
        let y = dequantize(self.0 >> 16);
        from_square(Vec2::new(x, y))
    }

    /// The code of the given coordinates on the square.
    #[inline]
    #[must_use]
    pub const fn from_xy(x: u16, y: u16) -> Self {
        Self(x as u32 | (y as u32) << 16)
    }

    /// The coordinates on the square.
    #[inline]
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "takes the halves")]
    pub const fn xy(self) -> (u16, u16) {
        (self.0 as u16, (self.0 >> 16) as u16)
    }

    /// The code whose word is `bits`.
    #[inline]
    #[must_use]
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The code as a word.
    #[inline]
    #[must_use]
    pub const fn to_bits(self) -> u32 {
        self.0
    }
}

/// The place of the direction of `v`, which need not have unit length, on the square `[-1, 1]^2`:
/// the octahedron unfolded.
///
/// # Source
/// `[Cigolle2014]`, section 3.
#[inline]
#[must_use]
pub fn to_square(v: Vec3) -> Vec2 {
    let v = v / (v.x.abs() + v.y.abs() + v.z.abs());
    let (x, y) = if v.z >= 0.0 {
        (v.x, v.y)
    } else {
        fold(v.x, v.y)
    };
    Vec2::new(x, y)
}

/// The unit vector of a place on the square `[-1, 1]^2`: undoes [`to_square`] but for rounding,
/// which turns it by less than 5e-7.
#[inline]
#[must_use]
pub fn from_square(Vec2 { x, y }: Vec2) -> Vec3 {
    let z = 1.0 - (x.abs() + y.abs());
    // By the sign alone, for z is never -0.
    let is_above = z.is_sign_positive();
    let (x, y) = if is_above { (x, y) } else { fold(x, y) };
    let v = Vec3::new(x, y, z);
    v / sqrt(v.length_squared())
}

/// Exchanges the inside of the diamond `|x| + |y| < 1` with the outside.
#[inline]
fn fold(x: f32, y: f32) -> (f32, f32) {
    ((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y))
}

/// The code of a coordinate, which a rounded quotient by a sum that is not smaller keeps within
/// `[-1, 1]`.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between 0.5 and 65535.5; the conversion saturates and sends NaN to 0"
)]
fn quantize(f: f32) -> u32 {
    (0.5 * (f + 1.0) * 65535.0 + 0.5) as u32
}

/// The coordinate of a code.
// Without an operating system memory for code is short: both coordinates call one function.
#[cfg_attr(target_os = "none", inline(never))]
#[cfg_attr(not(target_os = "none"), inline)]
fn dequantize(q: u32) -> f32 {
    let q = if cfg!(target_os = "none") {
        // The low bits of a float whose last place is 1: exact as well, and a processor without
        // floats needs no routine for the conversion.
        const ONES: f32 = 8_388_608.0;
        f32::from_bits(ONES.to_bits() | q) - ONES
    } else {
        q as f32
    };
    2.0 * (q / 65535.0) - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The vector in double precision, with its length.
    fn precise(v: Vec3) -> ([f64; 3], f64) {
        let v = v.to_array().map(f64::from);
        (v, v.iter().map(|x| x * x).sum::<f64>().sqrt())
    }

    fn angle(a: Vec3, b: Vec3) -> f64 {
        let ((a, la), (b, lb)) = (precise(a), precise(b));
        let chord_sq: f64 = (0..3).map(|i| (a[i] / la - b[i] / lb).powi(2)).sum();
        2.0 * (0.5 * chord_sq.sqrt()).asin()
    }

    proptest! {
        #[test]
        fn directions_come_back_from_the_square(
            x in -1.0f32..1.0,
            y in -1.0f32..1.0,
            z in -1.0f32..1.0,
        ) {
            let v = Vec3::new(x, y, z);
            prop_assume!(v.length() > 0.1);
            let d = from_square(to_square(v));
            prop_assert!(angle(v, d) < 5e-7, "{v} became {d}");
        }
    }

    fn assert_unit(code: OctahedralVector) {
        let (_, length) = precise(code.decode());
        assert!(
            (length - 1.0).abs() <= 2.0 * f64::from(f32::EPSILON),
            "length of {code:?}: {length}"
        );
    }

    #[test]
    fn axes() {
        for v in [
            Vec3::X,
            Vec3::Y,
            Vec3::NEG_X,
            Vec3::NEG_Y,
            Vec3::Z,
            Vec3::NEG_Z,
        ] {
            let d = OctahedralVector::encode(v).decode();
            assert!(
                angle(v, d) <= f64::from(OctahedralVector::MAX_ANGULAR_ERROR),
                "{v} became {d}"
            );
        }
    }

    /// Every code of each axis, along the borders, the diagonals and a middle line.
    #[test]
    fn lines_of_codes_are_unit_and_come_back() {
        for i in 0..=u16::MAX {
            let lines = [
                (i, 0),
                (65535, i),
                (i, i),
                (i, 65535 - i),
                (i, 32768),
                (12345, i),
            ];
            for (x, y) in lines {
                let code = OctahedralVector::from_xy(x, y);
                assert_unit(code);
                let again = OctahedralVector::encode(code.decode());
                // On the border two codes mean one direction.
                let on_border = [x, y].iter().any(|&q| q == 0 || q == 65535);
                assert!(
                    again == code || (on_border && angle(again.decode(), code.decode()) < 1e-6),
                    "{code:?} came back as {again:?}"
                );
            }
        }
    }

    #[test]
    fn nonsense_has_codes_too() {
        for v in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY, Vec3::X * 1e38] {
            assert_unit(OctahedralVector::encode(v));
        }
    }

    proptest! {
        #[test]
        fn error_is_bounded(
            v in prop::array::uniform3(-1.0f32..1.0).prop_map(Vec3::from), bits in any::<u32>(),
        ) {
            prop_assume!(v.length_squared() > 1e-6);
            let code = OctahedralVector::encode(v);
            prop_assert!(angle(v, code.decode()) <= f64::from(OctahedralVector::MAX_ANGULAR_ERROR));
            let any = OctahedralVector::from_bits(bits);
            assert_unit(any);
            prop_assert_eq!(OctahedralVector::from_xy(any.xy().0, any.xy().1).to_bits(), bits);
        }
    }
}
