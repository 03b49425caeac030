use super::asymmetry::{AsymmetryError, check_asymmetry};
use super::phase_function::PhaseFunction;
use core::f32::consts::PI;
use light_math::float;

/// The Henyey-Greenstein phase function of mean cosine `g`, the usual one for clouds, smoke, skin
/// and milk.
///
/// # Source
/// `[HenyeyGreenstein1941]`; sampling as in `[PBRT4]`, section 11.3.1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HenyeyGreenstein {
    g: f32,
}

impl HenyeyGreenstein {
    /// Below this `g` the inversion divides by a number that is mostly rounding error, and the
    /// linear term is accurate enough.
    const NEARLY_ISOTROPIC: f32 = 1e-3;

    /// The phase function with mean cosine `g`: positive for forward scattering, negative for
    /// backward scattering.
    ///
    /// # Errors
    /// `g` does not lie strictly between -1 and 1.
    pub fn new(g: f32) -> Result<Self, AsymmetryError> {
        check_asymmetry(g).map(|g| Self { g })
    }

    /// The mean cosine of deflection.
    #[must_use]
    pub const fn g(&self) -> f32 {
        self.g
    }
}

impl PhaseFunction for HenyeyGreenstein {
    #[inline]
    fn value(&self, cos_theta: f32) -> f32 {
        let g = self.g;
        // 1 + g^2 - 2 g cos, written so that it does not cancel where it is smallest: for a
        // direction straight forward or, where g is negative, straight back.
        let narrow = 1.0 - g.abs();
        let from_peak = (1.0 - cos_theta * g.signum()).max(0.0);
        let denominator = narrow * narrow + 2.0 * g.abs() * from_peak;
        (narrow * (1.0 + g.abs())) / (4.0 * PI * denominator * float::sqrt(denominator))
    }

    #[inline]
    fn sample_cos(&self, u: f32) -> f32 {
        let g = self.g;
        let x = 2.0 * u - 1.0;
        if g.abs() < Self::NEARLY_ISOTROPIC {
            // To first order in g the density is (1 + 3 g cos) / 2.
            return (x + 1.5 * g * (1.0 - x * x)).clamp(-1.0, 1.0);
        }
        let q = (1.0 - g * g) / (1.0 + g * x);
        ((1.0 + g * g - q * q) / (2.0 * g)).clamp(-1.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_has_no_density() {
        for g in [1.0, -1.0, 1.5, f32::NAN, f32::INFINITY] {
            assert_eq!(
                HenyeyGreenstein::new(g),
                Err(AsymmetryError::OutOfRange),
                "{g}"
            );
        }
    }

    /// Also a little beyond a cosine of 1, as a product of two unit vectors may be.
    #[test]
    fn peaks_are_as_high_forward_as_back() {
        for g in [0.5, 0.999, 0.9999, 1.0 - f32::EPSILON] {
            // (1 - g^2) / (4 pi (1 - g)^3).
            let peak =
                f64::from(1.0 + g) / (4.0 * core::f64::consts::PI * f64::from(1.0 - g).powi(2));
            for (g, cos) in [
                (g, 1.0),
                (-g, -1.0),
                (g, 1.0 + f32::EPSILON),
                (-g, -1.000_000_1),
            ] {
                let value = HenyeyGreenstein::new(g).expect("in range").value(cos);
                assert!(
                    (f64::from(value) / peak - 1.0).abs() < 1e-5,
                    "{g}, {cos}: {value}, {peak}"
                );
            }
        }
    }

    #[test]
    fn mean_cosine_is_g() {
        for g in [-0.9, -0.2, 0.0, 5e-4, 0.6, 0.95] {
            let f = HenyeyGreenstein::new(g).expect("in range");
            assert_eq!(f.g(), g, "as given");
            let n = 20_000u16;
            let mean = (0..n)
                .map(|i| f64::from(f.sample_cos((f32::from(i) + 0.5) / f32::from(n))))
                .sum::<f64>()
                / f64::from(n);
            let margin = 1e-3 * f64::from(g.abs()) + 1e-6;
            assert!(
                (mean - f64::from(g)).abs() < margin,
                "mean {mean} for g {g}"
            );
        }
    }
}
