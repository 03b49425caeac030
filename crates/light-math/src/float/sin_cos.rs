//! Sine, cosine and tangent by 32-bit floats and whole numbers alone: those of `libm` compute with
//! 64-bit floats, which small processors only have as routines.
//!
//! The angle becomes a quadrant and a rest in `[-pi/4, pi/4]`, which is a sum of two floats, and
//! polynomials take it from there. Coefficients are the best ones after rounding, by Remez's
//! algorithm: the relative error of the sine is below 2^-28, that of the cosine below 2^-33.

use core::f32::consts::{FRAC_2_PI, FRAC_PI_2};

/// Sine and cosine of `x` radians, within 0.8 units of the last place each; NaN for infinity.
pub(super) fn sin_cos(x: f32) -> (f32, f32) {
    // As well as any polynomial, and it keeps the sign of zero.
    if x.abs() < 1.0 / 4096.0 {
        return (x, 1.0);
    }
    let (quadrant, r, low) = if x.abs() < 40.0 {
        near_rest(x)
    } else {
        far_rest(x)
    };
    let z = r * r;
    let half = 0.5 * z;
    let w = 1.0 - half;
    let odd = -0.166_666_55 + z * (8.332_19e-3 + z * -1.951_840_5e-4);
    let even = 4.166_664_6e-2 + z * (-1.388_730_1e-3 + z * 2.443_067e-5);
    let sin = r + (low * w + r * z * odd);
    let cos = w + ((1.0 - w - half) + (z * z * even - r * low));
    match quadrant & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// Sine of `x` radians.
pub(super) fn sin(x: f32) -> f32 {
    sin_cos(x).0
}

/// Cosine of `x` radians.
pub(super) fn cos(x: f32) -> f32 {
    sin_cos(x).1
}

/// Tangent of `x` radians, within 2.2 units of the last place.
pub(super) fn tan(x: f32) -> f32 {
    let (sin, cos) = sin_cos(x);
    sin / cos
}

/// The quadrant of an angle below 40, and the rest as a sum of a float and a smaller one.
///
/// `pi / 2` has three parts. The product of a quadrant, of 5 bits, and one of the first two, of 19
/// bits, is exact, and so is its difference to the angle, or what rounding takes from it is kept.
#[expect(clippy::cast_possible_truncation, reason = "truncation is the purpose")]
fn near_rest(x: f32) -> (i32, f32, f32) {
    let quadrant = (x * FRAC_2_PI + 0.5f32.copysign(x)) as i32;
    let k = quadrant as f32;
    let a = x - k * 1.570_793_2;
    let b = k * 3.174_936_9e-6;
    let head = a - b;
    let lost = k * 2.563_344e-12 - (a - head - b);
    let r = head - lost;
    (quadrant, r, head - r - lost)
}

/// The bits of `2 / pi` behind the point, and 32 zeros before them.
const TWO_OVER_PI: [u32; 8] = [
    0,
    0xa2f9_836e,
    0x4e44_1529,
    0xfc27_57d1,
    0xf534_ddc0,
    0xdb62_9599,
    0x3c43_9041,
    0xfe51_63ab,
];

/// The same for any angle of at least 1, by whole numbers: the mantissa times those bits of
/// `2 / pi` that give less than four quadrants.
///
/// # Source
/// M. Payne, R. Hanek, "Radian reduction for trigonometric functions", SIGNUM Newsletter 18 (1983).
#[cold]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "the upper half of a word and the sign of a rest"
)]
fn far_rest(x: f32) -> (i32, f32, f32) {
    if !x.is_finite() {
        return (0, f32::NAN, f32::NAN);
    }
    let bits = x.to_bits();
    let mantissa = u64::from(bits & 0x7f_ffff | 0x80_0000);
    // x is mantissa * 2^(exponent - 150), and bit i of 2 / pi has the place 31 + i.
    let exponent = bits >> 23 & 0xff;
    let start = exponent - 120;
    let word = |i: u32| u64::from(TWO_OVER_PI[(start / 32 + i) as usize & 7]);
    let window = |i| ((word(i) << 32 | word(i + 1)) << (start % 32)) >> 32;
    let high = (window(0) << 32 | window(1)).wrapping_mul(mantissa);
    // In quadrants of 2^62, without whole turns.
    let turn = high.wrapping_add((window(2) * mantissa) >> 32);
    let nearest = turn.wrapping_add(1 << 61) >> 62;
    let rest = turn.wrapping_sub(nearest << 62) as i64;
    let quadrant = nearest as i32;
    // Products of 12 bits are exact.
    const UNIT: f32 = 1.0 / (1u64 << 62) as f32;
    const HEAD: f32 = 1.570_312_5;
    let head = f32::from_bits((rest as f32).to_bits() & !0xfff);
    let tail = (rest - head as i64) as f32;
    let product = head * UNIT * HEAD;
    let low = head * UNIT * 4.838_268e-4 + tail * UNIT * FRAC_PI_2;
    let r = product + low;
    let (r, low) = (r, product - r + low);
    if x < 0.0 {
        (-quadrant, -r, -low)
    } else {
        (quadrant, r, low)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose")]
    const fn nearest(x: f64) -> f32 {
        x as f32
    }

    /// The difference to the exact value in units of the last place of the nearest float.
    fn ulps(found: f32, exact: f64) -> f64 {
        let nearest = nearest(exact).abs().max(f32::MIN_POSITIVE);
        let ulp = f64::from(f32::from_bits(nearest.to_bits() + 1)) - f64::from(nearest);
        (f64::from(found) - exact).abs() / ulp
    }

    /// Every 499th float between two, and its negative.
    fn floats(from: f32, to: f32) -> impl Iterator<Item = f32> {
        let all = (from.to_bits()..to.to_bits()).step_by(499);
        all.map(f32::from_bits).flat_map(|x| [x, -x])
    }

    fn worst(from: f32, to: f32) -> [f64; 3] {
        let mut worst = [0.0f64; 3];
        for x in floats(from, to) {
            let (sin, cos) = (sin(x), cos(x));
            let (exact_sin, exact_cos) = f64::from(x).sin_cos();
            let all = [
                ulps(sin, exact_sin),
                ulps(cos, exact_cos),
                ulps(tan(x), exact_sin / exact_cos),
            ];
            for (worst, ulps) in worst.iter_mut().zip(all) {
                *worst = worst.max(ulps);
            }
        }
        worst
    }

    #[test]
    fn values_are_within_their_bounds() {
        for (from, to) in [(1e-9, 0.7), (0.7, 8.0), (8.0, 48.0), (48.0, f32::MAX)] {
            let [sin, cos, tan] = worst(from, to);
            assert!(sin < 0.8 && cos < 0.8, "{from} to {to}: {sin} and {cos}");
            assert!(tan < 2.2, "{from} to {to}: {tan}");
        }
    }

    /// The floats next to the multiples of a quarter turn, where little is left of the angle.
    #[test]
    fn values_near_zeros_are_as_good() {
        for k in 1..40_000 {
            let x = nearest(f64::from(k) * core::f64::consts::FRAC_PI_2);
            let (sin, cos) = sin_cos(x);
            let (exact_sin, exact_cos) = f64::from(x).sin_cos();
            let off = ulps(sin, exact_sin).max(ulps(cos, exact_cos));
            assert!(off < 0.8, "{off} at {x}");
        }
    }

    #[test]
    fn both_ways_to_the_rest_agree() {
        for x in floats(1.0, 40.0) {
            let [(k, r, low), (q, s, small)] = [near_rest(x), far_rest(x)];
            let turn = (k - q) & 3;
            assert_eq!(turn, 0, "{x}: the same quadrant");
            let off = (f64::from(r) + f64::from(low)) - (f64::from(s) + f64::from(small));
            assert!(off.abs() < 1e-10, "{x}: {off}");
        }
    }

    #[test]
    fn zeros_keep_their_sign_and_infinity_has_no_sine() {
        assert_eq!(sin_cos(-0.0).0.to_bits(), (-0.0f32).to_bits(), "zero");
        for x in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
            let (sin, cos) = sin_cos(x);
            assert!(sin.is_nan() && cos.is_nan() && tan(x).is_nan(), "{x}");
        }
    }
}
