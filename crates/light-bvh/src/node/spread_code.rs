//! How far axis and offset of a child vary, and the shape of its emission, in a byte.

use crate::lane_math::LaneMask;

/// How much of its squared spread and distance counts as variance of a child's emission. Chosen by V
/// for ramps; the spread of steps is encoded so that it is theirs as well.
pub(crate) const BY_SPREAD: f32 = 0.27;

/// Bit 7: it emits in a step. Bit 6: it is soft, anything but one flat light or one spot. Below: the
/// spread, of `[1, 240]`, three bits of exponent and three of mantissa.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SpreadCode(pub(crate) u8);

/// The bits of the exponent of 1 in an `f32`.
const ONE: i32 = 127 << 23;

impl SpreadCode {
    /// The code of the least spread that is not below `spread`, or of the largest.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the code is of 0 to 63"
    )]
    pub(crate) const fn new(spread: f32, is_step: bool, is_soft: bool) -> Self {
        let code = (spread.to_bits() as i32 - ONE + 0x000f_ffff) >> 20;
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
    #[expect(clippy::cast_sign_loss, reason = "the bits of a positive float")]
    pub(crate) const fn value(self) -> f32 {
        f32::from_bits((((self.wide() & 63) << 20) + ONE) as u32)
    }
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;

    #[test]
    fn codes_come_back_and_spreads_are_rounded_up() {
        for code in 0..=255u8 {
            let code = SpreadCode(code);
            let again = SpreadCode::new(code.value(), code.step().is_set(), code.soft().is_set());
            assert_eq!(again, code, "{code:?}");
        }
        let mut spread = 1.0;
        while spread < 240.0 {
            let decoded = SpreadCode::new(spread, false, true).value();
            assert!(
                decoded >= spread && decoded < 1.126 * spread,
                "{spread}: {decoded}"
            );
            spread *= 1.01;
        }
        assert_eq!(SpreadCode::new(0.0, false, false).value(), 1.0, "the least");
        assert_eq!(
            SpreadCode::new(1e9, true, true).value(),
            240.0,
            "the largest"
        );
    }
}
