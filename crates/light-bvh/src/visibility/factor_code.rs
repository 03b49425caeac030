//! The factor of a child's importance in one byte: five bits of exponent and three of mantissa.

/// The code of factor 1.
pub(crate) const ONE: u8 = 192;

/// The code of the least factor, 2^-9.
pub(crate) const LEAST: u8 = 120;

/// The code of the largest factor, 64.
pub(crate) const LARGEST: u8 = 240;

/// The float to which queries decode the factor 1: only proportions count, and no product with a
/// weight overflows.
pub(crate) const UNIT: f32 = 1.0 / 256.0;

/// The exponent of code 0 as queries decode it.
const BASE: u32 = 95;

/// The factor of any code, in the [`UNIT`] of queries: a normal number of `[2^-32, 1)`.
#[inline(always)]
pub(crate) const fn decode_scaled(code: u8) -> f32 {
    f32::from_bits(((code as u32) << 20) + (BASE << 23))
}

/// The factor that a code of a [cell](crate::visibility::CellFactors) means, of `[2^-9, 64]` for
/// the codes of its domain, `120..=240`; 192 means 1.
#[inline]
#[must_use]
pub const fn decode_factor(code: u8) -> f32 {
    decode_scaled(code) / UNIT
}

/// The code nearest to `factor`, which is first moved into `[2^-9, 64]`; not a number counts as 1.
///
/// A code is off by at most a sixteenth of its factor.
#[inline]
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    reason = "of the largest factor, the code is 240"
)]
pub const fn encode_factor(factor: f32) -> u8 {
    if factor.is_nan() {
        return ONE;
    }
    let factor = factor.clamp(decode_factor(LEAST), decode_factor(LARGEST)) * UNIT;
    // The code is the float's top bits, so rounding to nearest adds half of the last of them.
    let bits = factor.to_bits() + (1 << 19);
    ((bits >> 20) - (BASE << 3)) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_come_back() {
        assert_eq!(decode_factor(ONE), 1.0, "one");
        assert_eq!(decode_factor(LEAST), 1.0 / 512.0, "the least");
        assert_eq!(decode_factor(LARGEST), 64.0, "the largest");
        for code in LEAST..=LARGEST {
            assert_eq!(encode_factor(decode_factor(code)), code, "code");
        }
    }

    #[test]
    fn factors_are_rounded_to_the_nearest_code_of_the_domain() {
        let mut factor = decode_factor(LEAST);
        while factor < decode_factor(LARGEST) {
            let decoded = decode_factor(encode_factor(factor));
            assert!(
                (decoded - factor).abs() <= factor / 16.0,
                "{factor}: {decoded}"
            );
            factor *= 1.003;
        }
        for (factor, code) in [
            (0.0, LEAST),
            (-1.0, LEAST),
            (1e-30, LEAST),
            (1e30, LARGEST),
            (f32::INFINITY, LARGEST),
            (f32::NAN, ONE),
        ] {
            assert_eq!(encode_factor(factor), code, "{factor}");
        }
    }

    #[test]
    fn every_code_is_a_positive_factor_below_one_in_the_unit_of_queries() {
        assert_eq!(decode_scaled(ONE), UNIT, "one");
        for code in 0..=u8::MAX {
            let factor = decode_scaled(code);
            assert!(factor.is_normal() && factor > 0.0 && factor < 1.0, "{code}");
        }
    }
}
