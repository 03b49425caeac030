//! How far the emission of a child varies, and its shape, in a byte.

use crate::lane_math::LaneMask;
use crate::node::wide_node::WideNode;

/// How much of the squared deviation of axis and offset, and of 1 more, counts as variance of a
/// ramp, in codes. Chosen by V.
#[cfg(feature = "alloc")]
pub(crate) const RAMP_BY_SPREAD: f32 = 0.27;

/// The least spread: that of one flat light, the root of [`RAMP_BY_SPREAD`].
pub(crate) const LEAST_SPREAD: f32 = 0.519_615_24;

/// Bit 7: it emits in a step. Bit 6: it is soft, anything but one flat light or one spot. Below:
/// the spread, of `[0.52, 122]`, in steps of at most an eighth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SpreadCode(pub(crate) u8);

/// The bits of [`LEAST_SPREAD`]. The next spreads follow in bits 20 and up: three are of the
/// mantissa.
const LEAST_BITS: u32 = LEAST_SPREAD.to_bits();

impl SpreadCode {
    /// The code of the least spread that is not below `spread`, or of the largest.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss,
        reason = "bits of positive floats; the code is of 0 to 63"
    )]
    pub(crate) const fn new(spread: f32, is_step: bool, is_soft: bool) -> Self {
        let code = (spread.to_bits() as i32 - LEAST_BITS as i32 + 0x000f_ffff) >> 20;
        let code = if code > 0 { code } else { 0 };
        let code = if code < 63 { code } else { 63 };
        Self(code as u8 | (is_step as u8) << 7 | (is_soft as u8) << 6)
    }

    /// In 32 bits, so that the sign is bit 7.
    #[inline(always)]
    const fn wide(self) -> i32 {
        self.0 as i8 as i32
    }

    #[inline(always)]
    pub(crate) const fn step(self) -> LaneMask {
        LaneMask::of_sign(self.wide())
    }

    #[inline(always)]
    pub(crate) const fn soft(self) -> LaneMask {
        LaneMask::of_sign(self.wide() << 25)
    }

    /// The spread.
    #[inline(always)]
    #[expect(clippy::cast_sign_loss, reason = "6 bits")]
    pub(crate) const fn value(self) -> f32 {
        f32::from_bits((((self.wide() & 63) as u32) << 20) + LEAST_BITS)
    }
}

impl WideNode {
    /// Whether a light of child `k` emits in a step.
    #[inline]
    pub(crate) const fn is_step(&self, k: usize) -> bool {
        SpreadCode(self.spread[k]).step().is_set()
    }

    /// Whether child `k` is a group of lights of which one does.
    #[cfg(feature = "alloc")]
    pub(crate) const fn is_step_group(&self, k: usize) -> bool {
        let spread = SpreadCode(self.spread[k]);
        spread.step().and(spread.soft()).is_set()
    }

    /// Whether a light of any child does.
    #[inline]
    pub(crate) const fn has_steps(&self) -> bool {
        u128::from_ne_bytes(self.spread) & (u128::MAX / 0xff * 0x80) != 0
    }
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use crate::node::wide_node::WIDTH;

    #[test]
    fn codes_come_back_and_spreads_are_rounded_up() {
        for code in 0..=255u8 {
            let code = SpreadCode(code);
            let again = SpreadCode::new(code.value(), code.step().is_set(), code.soft().is_set());
            assert_eq!(again, code, "{code:?}");
        }
        let mut spread = LEAST_SPREAD;
        while spread < 122.0 {
            let decoded = SpreadCode::new(spread, false, true).value();
            assert!(
                decoded >= spread && decoded < 1.126 * spread,
                "{spread}: {decoded}"
            );
            spread *= 1.01;
        }
        let least = SpreadCode::new(0.0, false, false).value();
        assert_eq!(least, LEAST_SPREAD, "the least");
        let largest = SpreadCode::new(1e9, true, true).value();
        assert!((122.0..123.0).contains(&largest), "the largest: {largest}");
        let least_sq = LEAST_SPREAD * LEAST_SPREAD;
        assert!((least_sq - RAMP_BY_SPREAD).abs() < 1e-7, "of a flat light");
    }

    #[test]
    fn a_node_has_steps_if_one_child_does() {
        let mut node = WideNode::EMPTY;
        node.spread.fill(SpreadCode::new(122.0, false, true).0);
        assert!(!node.has_steps(), "all are ramps");
        for k in 0..WIDTH {
            let ramp = core::mem::replace(&mut node.spread[k], SpreadCode::new(0.0, true, false).0);
            assert!(node.has_steps(), "{k}");
            node.spread[k] = ramp;
        }
    }
}
