//! Random numbers of 64 bits: a `u64` is a fraction of 2^64, from 0 up to but not including 1.
//!
//! A choice uses up as many bits as its probability has and leaves the rest, so one number serves a
//! whole chain of choices. All of it is integer arithmetic that a 32-bit machine does as well, with
//! the same result.

/// 2^32, the number of values of a word.
const WORDS: f32 = 4_294_967_296.0;

/// 2^-24, the distance between two fractions in single precision.
const STEP_OF_F32: f32 = 1.0 / 16_777_216.0;

/// The fraction whose upper half is `high`, for example a point of a Sobol sequence, and whose
/// lower half is `low`, for example a hash.
#[inline]
#[must_use]
pub const fn from_words(high: u32, low: u32) -> u64 {
    (high as u64) << 32 | low as u64
}

/// The fraction whose upper 24 bits are `u` in `[0, 1)` and whose lower 40 bits are the upper ones
/// of `fill`, another random number.
///
/// Without bits to fill in a million lights are chosen on a grid. Numbers outside of the domain are
/// moved into it, NaN to 0.
#[inline]
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast truncates on purpose and saturates"
)]
pub const fn from_f32(u: f32, fill: u64) -> u64 {
    let high = (u * 16_777_216.0) as u32;
    let high = if high < 1 << 24 { high } else { (1 << 24) - 1 };
    (high as u64) << 40 | fill >> 24
}

/// The fraction whose upper 53 bits are `u` in `[0, 1)`; the rest are 0. Numbers outside of the
/// domain are moved into it, NaN to 0.
#[inline]
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast truncates on purpose and saturates"
)]
pub const fn from_f64(u: f64) -> u64 {
    let high = (u * 9_007_199_254_740_992.0) as u64;
    let high = if high < 1 << 53 { high } else { (1 << 53) - 1 };
    high << 11
}

/// The upper 24 bits of `u` as a number in `[0, 1)`.
#[inline]
#[must_use]
pub const fn to_f32(u: u64) -> f32 {
    // By way of a word: processors without 64 bits have no conversion of more.
    (u >> 40) as u32 as f32 * STEP_OF_F32
}

/// The upper 53 bits of `u` as a number in `[0, 1)`.
#[inline]
#[must_use]
pub const fn to_f64(u: u64) -> f64 {
    (u >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
}

/// One of the numbers `0..count` with equal probability, and what is left of `u`; `count` is at
/// least 1.
///
/// The count of all `u` that lead to a number differs from the others' by less than 1.
#[inline]
#[must_use]
pub const fn choose(count: u32, u: u64) -> (u32, u64) {
    // The product of 96 bits, from two of 32 by 32 bits.
    let low = (u & 0xffff_ffff) * count as u64;
    let high = (u >> 32) * count as u64 + (low >> 32);
    ((high >> 32) as u32, high << 32 | (low & 0xffff_ffff))
}

/// Whether `u` is below `chance`: true for the nearest 2^-64 to `chance` of all `u`, for none if it
/// is 0 or NaN, for all if it is 1 or more.
///
/// All bits of `u` count, so that chances far below 2^-24 are met as well.
#[inline]
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the casts truncate on purpose"
)]
pub const fn is_below(u: u64, chance: f32) -> bool {
    let scaled = chance * WORDS;
    if scaled >= WORDS {
        return true;
    }
    // Exact: a float below 2^32 less its whole part.
    let high = scaled as u32;
    let low = (scaled - high as f32) * WORDS;
    u < from_words(high, low as u32)
}

/// The fraction at the relative position `u` in the `i`th of `count` equal parts of `[0, 1)`;
/// `i < count`.
#[inline]
#[must_use]
pub const fn stratum(i: u32, count: u32, u: u64) -> u64 {
    let count = count as u64;
    let high = (i as u64) << 32 | u >> 32;
    let low = (high % count) << 32 | (u & 0xffff_ffff);
    ((high / count) << 32) | (low / count)
}

/// `(r + u) / g` as a fraction, rounded down: the inverse of a choice of probability
/// `g / 2^16`. `r < g <= 65536`.
#[inline(always)]
#[must_use]
pub const fn divide(r: u32, u: u64, g: u32) -> u64 {
    if cfg!(target_pointer_width = "64") {
        divide_by_u64(r, u, g)
    } else {
        divide_by_u32(r, u, g)
    }
}

/// [`divide`] in two divisions.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "both are below 2^32")]
const fn divide_by_u64(r: u32, u: u64, g: u32) -> u64 {
    let g = g as u64;
    let x = (r as u64) << 48 | u >> 16;
    let rest = (x % g) << 16 | (u & 0xffff);
    ((x / g) << 16) | (rest as u32 / g as u32) as u64
}

/// [`divide`] for machines that divide no 64-bit numbers.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "splits a word")]
const fn divide_by_u32(r: u32, u: u64, g: u32) -> u64 {
    let (h, l) = ((u >> 32) as u32, u as u32);
    let n = r << 16 | h >> 16;
    let q3 = n / g;
    let n = (n % g) << 16 | (h & 0xffff);
    let q2 = n / g;
    let n = (n % g) << 16 | l >> 16;
    let q1 = n / g;
    let n = (n % g) << 16 | (l & 0xffff);
    from_words(q3 << 16 | q2, (q1 << 16) | (n / g))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers whose words are 0, all ones, or about anything.
    fn words() -> impl Iterator<Item = u64> {
        let mixed = (1..200u64).map(|i| i.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        [0, 1, 1 << 32, 0xffff_ffff, 1 << 63, u64::MAX]
            .into_iter()
            .chain(mixed)
    }

    #[test]
    fn division_is_exact_in_both_forms() {
        for u in words() {
            for g in [1, 2, 3, 16, 255, 4097, 65535, 65536] {
                for r in [0, 1, g / 2, g - 1].into_iter().filter(|&r| r < g) {
                    let exact = (u128::from(r) << 64 | u128::from(u)) / u128::from(g);
                    assert_eq!(u128::from(divide_by_u64(r, u, g)), exact, "{r} {u} {g}");
                    assert_eq!(u128::from(divide_by_u32(r, u, g)), exact, "{r} {u} {g}");
                }
            }
        }
    }

    #[test]
    fn strata_are_exact() {
        for u in words() {
            for count in [1, 3, 16, 65537, u32::MAX] {
                for i in [0, count / 2, count - 1] {
                    let exact = (u128::from(i) << 64 | u128::from(u)) / u128::from(count);
                    assert_eq!(u128::from(stratum(i, count, u)), exact, "{i} {count} {u}");
                }
            }
        }
    }

    #[test]
    fn a_uniform_choice_is_the_product_by_the_count() {
        for u in words() {
            for count in [1, 3, 16, 65537, u32::MAX] {
                let product = u128::from(u) * u128::from(count);
                let (index, rest) = choose(count, u);
                assert_eq!(u128::from(index), product >> 64, "{u} {count}");
                assert_eq!(u128::from(rest), product & u128::from(u64::MAX), "{u}");
            }
        }
    }

    #[test]
    fn a_chance_is_met_by_all_bits() {
        for (chance, first_above) in [
            (0.25, 1 << 62),
            (0.3, 10_066_330 << 39),
            (1.0 - f32::EPSILON / 2.0, 0xff_ffff << 40),
            (3.0 / (1u64 << 31) as f32, 3 << 33),
            (1.0 / (1u64 << 50) as f32, 1 << 14),
        ] {
            assert!(is_below(first_above - 1, chance), "{chance}");
            assert!(!is_below(first_above, chance), "{chance}");
        }
        for chance in [0.0, -1.0, f32::NAN, 1e-30] {
            assert!(!is_below(0, chance), "{chance}");
        }
        for chance in [1.0, 7.0, f32::INFINITY] {
            assert!(is_below(u64::MAX, chance), "{chance}");
        }
    }

    #[test]
    fn floats_become_fractions_and_back() {
        for u in [0.0, 0.25, 0.999_999_94] {
            assert_eq!(to_f32(from_f32(u, u64::MAX)), u, "single precision");
            assert_eq!(to_f64(from_f64(f64::from(u))), f64::from(u), "double");
        }
        assert_eq!(from_f32(0.5, u64::MAX), (1 << 63) + (1 << 40) - 1, "filled");
        assert_eq!(from_words(1, 2), (1 << 32) + 2, "words");
    }

    #[test]
    fn nonsense_is_moved_into_the_domain() {
        for (u, high) in [
            (-1.0, 0),
            (f32::NAN, 0),
            (1.0, 0xff_ffff),
            (1e30, 0xff_ffff),
        ] {
            assert_eq!(from_f32(u, 0) >> 40, high, "{u}");
        }
        assert_eq!(from_f64(1.0), u64::MAX << 11, "the largest");
        assert_eq!(from_f64(f64::NAN), 0, "NaN");
        assert!(to_f32(u64::MAX) < 1.0 && to_f64(u64::MAX) < 1.0, "below 1");
    }
}
