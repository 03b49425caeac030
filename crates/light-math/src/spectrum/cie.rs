//! The CIE 1931 standard observer: from spectra to XYZ and luminance.

use glam::Vec3;

pub(super) use super::observer::{OBSERVER, SAMPLES, cubic};
pub use super::visible_range::{LAMBDA_MAX, LAMBDA_MIN};
use super::{SampledSpectrum, SampledWavelengths, Spectrum};

/// The integral of the luminous efficiency over the wavelengths, in nm.
pub const Y_INTEGRAL: f32 = 106.856_895;

/// The colour matching functions x, y, z at `lambda` nm, the nearest nanometre's value; 0 outside
/// of the range.
///
/// Taken at 5 nm from the standard and interpolated by cubics to 1 nm, as the standard recommends:
/// the sums over the range agree with those of its 1 nm table within 2e-6.
#[inline]
#[must_use]
pub fn matching(lambda: f32) -> Vec3 {
    nearest_nanometre(lambda).map_or(Vec3::ZERO, |i| OBSERVER[i])
}

/// XYZ of an emission spectrum, so that the constant spectrum 1 has `Y` = 1: by its
/// [`integrals`](Spectrum::integrals), so that narrow lines count in full.
#[must_use]
pub fn xyz(spectrum: &impl Spectrum) -> Vec3 {
    spectrum.integrals().xyz / Y_INTEGRAL
}

/// The estimate of XYZ from the values at sampled wavelengths, in the scale of [`xyz`].
#[must_use]
pub fn sampled_xyz<const N: usize>(
    spectrum: &SampledSpectrum<N>,
    wavelengths: &SampledWavelengths<N>,
) -> Vec3 {
    let mut sum = Vec3::ZERO;
    for i in 0..N {
        let pdf = wavelengths.pdf()[i];
        if pdf > 0.0 {
            sum += matching(wavelengths.lambda()[i]) * (spectrum[i] / pdf);
        }
    }
    sum / (N.max(1) as f32 * Y_INTEGRAL)
}

/// The estimate of the luminance `Y` from the values at sampled wavelengths, in the scale of
/// [`xyz`].
#[inline]
#[must_use]
pub fn sampled_y<const N: usize>(
    spectrum: &SampledSpectrum<N>,
    wavelengths: &SampledWavelengths<N>,
) -> f32 {
    sampled_xyz(spectrum, wavelengths).y
}

/// Which of the [`SAMPLES`] nanometres is nearest; `None` outside of the range, or for NaN.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between 0.5 and 470.5"
)]
pub(super) fn nearest_nanometre(lambda: f32) -> Option<usize> {
    (LAMBDA_MIN..=LAMBDA_MAX)
        .contains(&lambda)
        .then_some((lambda - LAMBDA_MIN + 0.5) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Constant, PiecewiseLinear};

    /// Sums of the standard's own 1 nm table.
    #[test]
    fn sums_agree_with_the_standard() {
        let sum = |c: usize| OBSERVER.iter().map(|o| f64::from(o[c])).sum::<f64>();
        for (c, expected) in [106.865_469, 106.856_895, 106.892_251].iter().enumerate() {
            assert!((sum(c) / expected - 1.0).abs() < 2e-6, "{c}: {}", sum(c));
        }
    }

    /// Some rows of the standard's 1 nm table that are not in ours.
    #[test]
    fn interpolated_rows_agree_with_the_standard() {
        assert_eq!(matching(555.0).y, 1.0, "the peak is a row of both");
        for (lambda, expected) in [(361.0, 0.000_145_847), (363.0, 0.000_184_003_7)] {
            assert!(
                (matching(lambda).x - expected).abs() < 5e-6,
                "x at {lambda}"
            );
        }
    }

    #[test]
    fn constant_spectrum_is_equal_energy_white() {
        let white = xyz(&Constant(1.0));
        assert!(white.distance(Vec3::ONE) < 5e-4, "{white}");
        assert!((white.y - 1.0).abs() < 1e-5, "{white}");
    }

    /// Triangles between two whole nanometres, across one, and across many.
    #[test]
    fn lines_count_by_their_width() {
        for (middle, half) in [(435.75, 0.125), (546.0, 0.125), (578.5, 0.25), (600.0, 8.0)] {
            let lambdas = [middle - half, middle, middle + half];
            let line = PiecewiseLinear::new(lambdas, [0.0, 3.0, 0.0]).expect("valid");
            let [below, above] = [middle.floor(), middle.floor() + 1.0].map(matching);
            let expected = 3.0 * half / Y_INTEGRAL * below.lerp(above, middle.fract());
            let error = xyz(&line).distance(expected) / expected.length();
            assert!(error < 1e-2, "{middle}: {} for {expected}", xyz(&line));
        }
    }

    #[test]
    fn nothing_outside_of_the_range() {
        for lambda in [359.9, 830.1, f32::NAN, f32::INFINITY] {
            assert_eq!(matching(lambda), Vec3::ZERO, "{lambda}");
        }
        assert!(matching(830.0).x > 0.0, "the last nanometre");
    }

    #[test]
    fn sampled_estimates_converge_to_the_integral() {
        let exact = xyz(&Constant(2.0));
        let n = 1000;
        for sample in [
            SampledWavelengths::<4>::uniform,
            SampledWavelengths::<4>::visible,
        ] {
            for terminated in [false, true] {
                let (mut sum, mut y) = (Vec3::ZERO, 0.0);
                for i in 0..n {
                    let w = sample((i as f32 + 0.5) / n as f32);
                    let w = if terminated {
                        w.terminate_secondary()
                    } else {
                        w
                    };
                    let spectrum = Constant(2.0).sample(&w);
                    sum += sampled_xyz(&spectrum, &w) / n as f32;
                    y += sampled_y(&spectrum, &w) / n as f32;
                }
                assert!(sum.distance(exact) < 5e-3, "{sum} for {exact}");
                assert_eq!(y, sum.y, "the luminance is Y");
            }
        }
    }
}
