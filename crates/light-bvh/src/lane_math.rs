//! Arithmetic that the compiler vectorises: no branches, and no lane depends on another.

use crate::node::wide_node::WIDTH;

/// The larger one, in one instruction; `b` if either is NaN.
#[inline(always)]
pub(crate) fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smaller one, in one instruction; `b` if either is NaN.
#[inline(always)]
pub(crate) fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The inner product of two vectors. Where floats are routines, five calls of them are more code
/// than one of this.
#[cfg_attr(soft_floats, inline(never))]
#[cfg_attr(not(soft_floats), inline(always))]
pub(crate) fn dot([ax, ay, az]: &[f32; 3], [bx, by, bz]: &[f32; 3]) -> f32 {
    ax * bx + ay * by + az * bz
}

/// About how likely a number is above 0, of which the mean and the root of the mean square are known.
#[cfg_attr(soft_floats, inline(never))]
#[cfg_attr(not(soft_floats), inline(always))]
pub(crate) fn likely_above_zero(mean: f32, root: f32) -> f32 {
    0.5 + 0.5 * mean / root
}

/// All ones or all zeros: a condition of a lane, in as many bits as the numbers that it selects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LaneMask(u32);

impl LaneMask {
    #[inline(always)]
    pub(crate) const fn when(condition: bool) -> Self {
        Self(if condition { u32::MAX } else { 0 })
    }

    /// The sign of a number, 1 where it is negative.
    #[inline(always)]
    #[expect(clippy::cast_sign_loss, reason = "all ones is a mask")]
    pub(crate) const fn of_sign(x: i32) -> Self {
        Self((x >> 31) as u32)
    }

    pub(crate) const fn is_set(self) -> bool {
        self.0 != 0
    }

    #[inline(always)]
    pub(crate) const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    #[inline(always)]
    pub(crate) const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    #[inline(always)]
    pub(crate) const fn and_not(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// The sign bit of a float where this is set, otherwise 0.
    #[inline(always)]
    pub(crate) const fn sign(self) -> u32 {
        self.0 & (1 << 31)
    }

    /// `x` where this is set, otherwise 0.
    #[inline(always)]
    pub(crate) const fn keep(self, x: f32) -> f32 {
        f32::from_bits(x.to_bits() & self.0)
    }

    /// 0 where this is set, otherwise `x`.
    #[inline(always)]
    pub(crate) const fn clear(self, x: f32) -> f32 {
        f32::from_bits(x.to_bits() & !self.0)
    }

    /// `a` where this is set, otherwise `b`.
    #[inline(always)]
    pub(crate) const fn select(self, a: f32, b: f32) -> f32 {
        f32::from_bits((a.to_bits() & self.0) | (b.to_bits() & !self.0))
    }
}

/// All lanes joined in pairs.
#[inline(always)]
pub(crate) fn reduce(mut lanes: [f32; WIDTH], join: impl Fn(f32, f32) -> f32) -> f32 {
    let mut half = WIDTH / 2;
    while half > 0 {
        for k in 0..half {
            lanes[k] = join(lanes[k], lanes[k + half]);
        }
        half /= 2;
    }
    lanes[0]
}

/// Between the integers of this many bits no fractions fit: adding it rounds to the nearest
/// integer.
const INTEGERS: f32 = 12_582_912.0;

/// The nearest integer, for numbers below 2^22.
#[inline(always)]
pub(crate) fn nearest(x: f32) -> f32 {
    (x + INTEGERS) - INTEGERS
}

/// The low byte of an integer below 2^22, as two's complement.
#[cfg(feature = "alloc")]
#[inline(always)]
pub(crate) fn low_byte(integer: f32) -> u8 {
    let [byte, ..] = (integer + INTEGERS).to_bits().to_le_bytes();
    byte
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;

    #[test]
    fn lanes_are_joined_once_each() {
        let some = [3.0, 7.0, -1.0, 0.0, 2.0, 9.0, -4.0];
        let lanes = core::array::from_fn(|k| some.get(k).copied().unwrap_or(0.5));
        let rest = 0.5 * (WIDTH - some.len()) as f32;
        assert_eq!(reduce(lanes, larger), 9.0, "the largest");
        assert_eq!(reduce(lanes, smaller), -4.0, "the smallest");
        assert_eq!(reduce(lanes, |a, b| a + b), 16.0 + rest, "the sum");
    }

    #[test]
    fn integers_are_nearest() {
        for (x, integer, byte) in [
            (0.49, 0.0, 0),
            (-0.51, -1.0, 0xff),
            (254.6, 255.0, 0xff),
            (-127.4, -127.0, 0x81),
        ] {
            assert_eq!(nearest(x), integer, "{x}");
            assert_eq!(low_byte(integer), byte, "{x}");
        }
    }
}
