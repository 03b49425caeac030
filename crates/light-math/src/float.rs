//! Floating-point functions that `core` lacks.
//!
//! The only place that chooses between the platform's functions (feature `std`) and software ones
//! (feature `libm`). `libm` wins when both are on: it is how a caller asks for the same bits on
//! every platform, and without routines of 64-bit floats. Only the square root is everywhere the
//! same anyway. Angles are radians.

#[cfg(any(feature = "libm", test))]
mod cube_root;
#[cfg(any(feature = "libm", test))]
mod sin_cos;

/// Only compiled where `lib.rs` refuses to: its error is then the only one.
#[cfg(not(any(feature = "std", feature = "libm")))]
const fn without_backend(_: &[f32]) -> f32 {
    f32::NAN
}

macro_rules! forward {
    ($($(#[$doc:meta])* $name:ident($($arg:ident),+) = $std:ident, $software:path;)+) => {$(
        $(#[$doc])*
        #[inline]
        #[must_use]
        pub fn $name($($arg: f32),+) -> f32 {
            #[cfg(feature = "libm")]
            {
                $software($($arg),+)
            }
            #[cfg(all(feature = "std", not(feature = "libm")))]
            {
                f32::$std($($arg),+)
            }
            #[cfg(not(any(feature = "std", feature = "libm")))]
            {
                without_backend(&[$($arg),+])
            }
        }
    )+};
}

forward! {
    /// Sine.
    sin(x) = sin, sin_cos::sin;
    /// Cosine.
    cos(x) = cos, sin_cos::cos;
    /// Tangent.
    tan(x) = tan, sin_cos::tan;
    /// Arc sine in `[-pi/2, pi/2]`; NaN outside `[-1, 1]`.
    asin(x) = asin, arc_sine;
    /// Arc cosine in `[0, pi]`; NaN outside `[-1, 1]`.
    acos(x) = acos, libm::acosf;
    /// Arc tangent in `[-pi/2, pi/2]`.
    atan(x) = atan, libm::atanf;
    /// Angle of the point `(x, y)` in `[-pi, pi]`.
    atan2(y, x) = atan2, libm::atan2f;
    /// `e^x`.
    exp(x) = exp, libm::expf;
    /// `e^x - 1`, accurate near 0.
    exp_m1(x) = exp_m1, libm::expm1f;
    /// Natural logarithm.
    ln(x) = ln, libm::logf;
    /// `x^y`.
    powf(x, y) = powf, libm::powf;
    /// Cube root.
    cbrt(x) = cbrt, cube_root::cbrt;
    /// Largest integer not above `x`.
    floor(x) = floor, libm::floorf;
    /// Smallest integer not below `x`.
    ceil(x) = ceil, libm::ceilf;
}

/// That of `libm` takes the square root of a 64-bit float.
#[cfg(feature = "libm")]
fn arc_sine(x: f32) -> f32 {
    atan2(x, sqrt((1.0 - x) * (1.0 + x)))
}

/// The product of two numbers of at least 0, such as probabilities: 0 only if one of them is, and
/// never by rounding alone. 0 for any other number.
#[cfg_attr(target_os = "none", inline(never))]
#[cfg_attr(not(target_os = "none"), inline(always))]
#[must_use]
pub fn positive_product(a: f32, b: f32) -> f32 {
    if a > 0.0 && b > 0.0 {
        (a * b).max(f32::MIN_POSITIVE)
    } else {
        0.0
    }
}

/// Square root; NaN below zero. IEEE 754 square roots are correctly rounded, so that the platform's
/// gives the same bits, and is used.
#[inline]
#[must_use]
pub fn sqrt(x: f32) -> f32 {
    #[cfg(feature = "std")]
    {
        f32::sqrt(x)
    }
    #[cfg(all(feature = "libm", not(feature = "std"), not(target_arch = "nvptx64")))]
    {
        libm::sqrtf(x)
    }
    #[cfg(all(feature = "libm", not(feature = "std"), target_arch = "nvptx64"))]
    {
        core::f32::math::sqrt(x)
    }
    #[cfg(not(any(feature = "std", feature = "libm")))]
    {
        without_backend(&[x])
    }
}

/// Sine and cosine of `x`.
#[inline]
#[must_use]
pub fn sin_cos(x: f32) -> (f32, f32) {
    #[cfg(feature = "libm")]
    {
        sin_cos::sin_cos(x)
    }
    #[cfg(all(feature = "std", not(feature = "libm")))]
    {
        f32::sin_cos(x)
    }
    #[cfg(not(any(feature = "std", feature = "libm")))]
    {
        (without_backend(&[x]), without_backend(&[x]))
    }
}

/// Square root of `max(x, 0)`: for radicands that are negative by rounding error alone.
#[inline]
#[must_use]
pub fn safe_sqrt(x: f32) -> f32 {
    sqrt(x.max(0.0))
}

/// Arc cosine of `x` clamped to `[-1, 1]`: radians in `[0, pi]`.
#[inline]
#[must_use]
pub fn safe_acos(x: f32) -> f32 {
    acos(x.clamp(-1.0, 1.0))
}

/// Arc sine of `x` clamped to `[-1, 1]`: radians in `[-pi/2, pi/2]`.
#[inline]
#[must_use]
pub fn safe_asin(x: f32) -> f32 {
    asin(x.clamp(-1.0, 1.0))
}

/// The largest `f32` below one: the upper end of `u`, which lies in `[0, 1)`.
pub const ONE_MINUS_EPSILON: f32 = 1.0 - f32::EPSILON / 2.0;

/// `2^-k` for `x` in `[2^k, 2^(k+1))`, as far as floats reach; not zero for any `x`: a scale
/// without any rounding.
///
/// It takes a positive `x` to `[1, 2)`, one of at least `2^127` to `[2, 4)`, and a subnormal one
/// below 1.
#[inline]
#[must_use]
pub fn inverse_power_of_two(x: f32) -> f32 {
    const EXPONENT: u32 = 0xff << (f32::MANTISSA_DIGITS - 1);
    const LARGEST: u32 = 0xfe << (f32::MANTISSA_DIGITS - 1);
    f32::from_bits(LARGEST.saturating_sub(x.to_bits() & EXPONENT)).max(f32::MIN_POSITIVE)
}

/// The smallest `f32` above `x`; `x` itself at the upper end and for NaN.
#[inline]
#[must_use]
pub const fn next_up(x: f32) -> f32 {
    if x.is_nan() || x == f32::INFINITY {
        x
    } else if x == 0.0 {
        f32::from_bits(1)
    } else if x > 0.0 {
        f32::from_bits(x.to_bits() + 1)
    } else {
        f32::from_bits(x.to_bits() - 1)
    }
}

/// The largest `f32` below `x`; `x` itself at the lower end and for NaN.
#[inline]
#[must_use]
pub const fn next_down(x: f32) -> f32 {
    -next_up(-x)
}

/// `1 - x` for `x` of `[0, 1]`, rounded down: a cosine that is rounded up excludes a part of its
/// cone.
#[inline]
#[must_use]
pub const fn one_minus_rounded_down(x: f32) -> f32 {
    let nearest = 1.0 - x;
    // The distance of a float from 1 is exact down to 1/2.
    if 1.0 - nearest < x {
        next_down(nearest)
    } else {
        nearest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_minus_something_small_is_not_rounded_up() {
        for x in [0.0, 1e-30, 1e-9, 2.9e-8, 3.1e-8, 1e-5, 0.3, 0.5, 0.7, 1.0] {
            let rounded = f64::from(one_minus_rounded_down(x));
            let below = (1.0 - f64::from(x)) - rounded;
            assert!(
                (0.0..=f64::from(f32::EPSILON)).contains(&below),
                "{x}: {below}"
            );
        }
    }

    #[test]
    fn products_of_positive_numbers_are_positive() {
        assert_eq!(positive_product(0.5, 0.25), 0.125, "a product");
        assert_eq!(
            positive_product(1e-30, 1e-30),
            f32::MIN_POSITIVE,
            "rounded up"
        );
        for none in [0.0, -1.0, f32::NAN] {
            assert_eq!(positive_product(none, 1.0), 0.0, "{none}");
            assert_eq!(positive_product(1.0, none), 0.0, "{none}");
        }
    }

    #[test]
    fn safe_functions_clamp_round_off() {
        assert_eq!(safe_sqrt(-1e-9), 0.0, "below zero");
        assert_eq!(safe_acos(1.0 + f32::EPSILON), 0.0, "above one");
        assert_eq!(
            safe_asin(-2.0),
            -core::f32::consts::FRAC_PI_2,
            "below minus one"
        );
    }

    #[test]
    fn arc_sines_are_those_of_wide_floats() {
        for x in (0..=1.0f32.to_bits()).step_by(1009).map(f32::from_bits) {
            let exact = f64::from(x).asin();
            let off = (f64::from(asin(x)) - exact).abs();
            assert!(off <= 2e-7 * exact, "{x}: {off}");
            assert_eq!(asin(-x), -asin(x), "{x}: an odd function");
        }
        assert_eq!(asin(1.0), core::f32::consts::FRAC_PI_2, "a right angle");
        assert!(asin(1.0 + f32::EPSILON).is_nan(), "no such angle");
    }

    #[test]
    fn units_are_exact() {
        assert_eq!(inverse_power_of_two(1.5), 1.0, "[1, 2)");
        assert_eq!(inverse_power_of_two(5.0), 0.25, "[4, 8)");
        assert!(inverse_power_of_two(0.0).is_finite(), "zero");
        for x in [f32::MIN_POSITIVE, 1e-20, 0.75, 1.0, 1.5, 3e7, f32::MAX] {
            let scaled = x * inverse_power_of_two(x);
            assert!((1.0..4.0).contains(&scaled), "{x} to {scaled}");
            let mantissa = |x: f32| x.to_bits() << 9;
            assert_eq!(mantissa(scaled), mantissa(x), "the digits of {x}");
        }
        assert!(
            f32::from_bits(1) * inverse_power_of_two(f32::from_bits(1)) > 0.0,
            "subnormal"
        );
        assert!(
            (f32::INFINITY * inverse_power_of_two(f32::INFINITY)).is_infinite(),
            "infinite"
        );
    }

    #[test]
    fn neighbours() {
        assert_eq!(next_up(1.0), 1.0 + f32::EPSILON, "above one");
        assert_eq!(next_down(1.0), ONE_MINUS_EPSILON, "below one");
        assert_eq!(next_down(next_up(0.0)), 0.0, "around zero");
        assert_eq!(next_up(-next_up(0.0)), 0.0, "from below zero");
        assert_eq!(next_up(f32::INFINITY), f32::INFINITY, "upper end");
        assert!(next_up(f32::NAN).is_nan(), "NaN");
    }

    #[test]
    fn one_minus_epsilon_is_the_predecessor_of_one() {
        assert_eq!(
            ONE_MINUS_EPSILON.to_bits() + 1,
            1.0f32.to_bits(),
            "neighbours"
        );
    }
}
