//! Cube roots by 32-bit floats alone: that of `libm` computes with 64-bit floats.

/// The cube root of `x`, within 0.55 units of the last place.
pub(super) fn cbrt(x: f32) -> f32 {
    // Zeros, infinities and NaN.
    if x == 0.0 || !x.is_finite() {
        return x + x;
    }
    if x.abs() < f32::MIN_POSITIVE {
        // 2^24 has an exact root.
        return cbrt(x * 16_777_216.0) / 256.0;
    }
    // x is a * scale^3, with a in [1, 8).
    let bits = x.abs().to_bits();
    let exponent = (bits >> 23) - 1;
    let (thirds, rest) = (exponent / 3, exponent % 3);
    let a = f32::from_bits(bits & 0x7f_ffff | (127 + rest) << 23);
    let scale = f32::from_bits((thirds + 85) << 23);
    // A third of the bits is a root within 6 %; a step of Halley's method cubes the error.
    let y = f32::from_bits(a.to_bits() / 3 + 0x2a51_19f2);
    let cube = y * y * y;
    let y = y - y * (cube - a) / (cube + cube + a);
    // The cube of 8 bits is exact, and so is its difference to a. The rest is the series of a root.
    let y = f32::from_bits((y.to_bits() + 0x8000) & !0xffff);
    let cube = y * y * y;
    let d = (a - cube) / cube;
    let third = 1.0 / 3.0;
    let y = y + y * (d * (third - d * (third * third - d * (5.0 / 81.0))));
    (y * scale).copysign(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[expect(clippy::cast_possible_truncation, reason = "the nearest float")]
    #[test]
    fn roots_are_within_their_bound() {
        let mut worst = 0.0f64;
        for x in (1..f32::INFINITY.to_bits()).step_by(1009) {
            let x = f32::from_bits(x);
            let exact = f64::from(x).cbrt();
            let nearest = exact as f32;
            let ulp = f64::from(f32::from_bits(nearest.to_bits() + 1)) - f64::from(nearest);
            worst = worst.max((f64::from(cbrt(x)) - exact).abs() / ulp);
            assert_eq!(cbrt(-x), -cbrt(x), "{x}: an odd function");
        }
        assert!(worst < 0.55, "{worst}");
    }

    #[test]
    fn cubes_have_exact_roots_and_the_rest_its_own() {
        for k in 0..=255u16 {
            let k = f32::from(k);
            assert_eq!(cbrt(k * k * k), k, "the root of a cube");
        }
        assert_eq!(cbrt(-0.0).to_bits(), (-0.0f32).to_bits(), "zero");
        assert_eq!(cbrt(f32::NEG_INFINITY), f32::NEG_INFINITY, "infinity");
        assert!(cbrt(f32::NAN).is_nan(), "NaN");
    }
}
