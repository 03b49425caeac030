/// `a / b * 2^exponent`, rounded once, but for a relative 2^-30; 0 or infinity where the range of
/// `f32` ends. `b` is not 0.
#[inline]
pub(super) const fn quotient(a: u128, b: u128, exponent: i32) -> f32 {
    if a == 0 {
        return 0.0;
    }
    let (shift_a, shift_b) = (a.leading_zeros(), b.leading_zeros());
    // 63 bits by 32 bits, both normalised: from 2^30 to 2^32.
    let ratio = (a << shift_a >> 65) as u64 / (b << shift_b >> 96) as u64;
    scaled(
        ratio as u32 as f32,
        exponent + shift_b as i32 - shift_a as i32 - 31,
    )
}

/// `x * 2^exponent`, for `x` from 2^30 to 2^32: in two steps, for one reaches half as far. The
/// first does not round.
#[inline]
const fn scaled(x: f32, exponent: i32) -> f32 {
    let half = exponent >> 1;
    x * power_of_two(half) * power_of_two(exponent - half)
}

/// `2^exponent`, or the end of the range of normal numbers that is nearer.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "the sum is kept above 0")]
const fn power_of_two(exponent: i32) -> f32 {
    let biased = 127 + exponent;
    let biased = if biased < 1 { 1 } else { biased };
    let biased = if biased > 254 { 254 } else { biased };
    f32::from_bits((biased as u32) << 23)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_are_rounded_once() {
        let wide = |i: u32| u128::from(i).wrapping_mul(0x9e37_79b9_7f4a_7c15_f39c_c060_5ced_c835);
        for i in 1..2000 {
            let (a, b) = (wide(i) >> (i % 97) | 1, wide(i + 7) >> (i % 89) | 1);
            // Both conversions and the division round to 53 bits.
            let exact = a as f64 / b as f64;
            let found = f64::from(quotient(a, b, 0));
            assert!(
                (found / exact - 1.0).abs() <= 0.5 * f64::from(f32::EPSILON) + 1e-9,
                "{a} / {b} = {found}"
            );
        }
        for x in [1, 3, 0xff_ffff, u128::MAX >> 1, u128::MAX] {
            assert_eq!(quotient(x, x, 0), 1.0, "{x} by itself");
        }
    }

    #[test]
    fn the_exponent_counts_to_the_ends_of_the_range() {
        assert_eq!(quotient(3, 4, 3), 6.0, "in the middle");
        assert_eq!(quotient(0, 5, 100), 0.0, "zero");
        assert_eq!(quotient(1, 1, -149), f32::from_bits(1), "the smallest");
        assert_eq!(quotient(3, 2, -149), f32::from_bits(2), "rounded to even");
        assert_eq!(quotient(1, 1, -151), 0.0, "below it");
        assert_eq!(quotient(1, 1, 127), (1u128 << 127) as f32, "the largest");
        assert_eq!(quotient(1, 1, 128), f32::INFINITY, "above it");
        assert_eq!(quotient(1, u128::MAX, -400), 0.0, "far below");
        assert_eq!(quotient(u128::MAX, 1, 400), f32::INFINITY, "far above");
    }
}
