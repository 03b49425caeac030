use super::asymmetry::{AsymmetryError, check_asymmetry};
use super::deflection::Deflection;
use super::phase_function::PhaseFunction;
use core::f32::consts::PI;
use light_math::float;

/// The Henyey-Greenstein phase function of mean cosine `g`, the usual one for clouds, smoke, skin
/// and milk.
///
/// # Source
/// `[HenyeyGreenstein1941]`; sampling as in `[PBRT4]`, section 11.3.1, solved for the distance of the
/// cosine from the peak, which keeps its digits where the peak is narrow.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HenyeyGreenstein {
    g: f32,
}

impl HenyeyGreenstein {
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

    /// The value where the cosine is less than that of the peak by `from_peak`: 1 straight forward
    /// or, where `g` is negative, straight back.
    #[inline]
    fn value_from_peak(&self, from_peak: f32) -> f32 {
        let g = self.g.abs();
        // 1 + g^2 - 2 g cos, written so that it does not cancel where it is smallest.
        let narrow = 1.0 - g;
        let denominator = narrow * narrow + 2.0 * g * from_peak;
        (narrow * (1.0 + g)) / (4.0 * PI * denominator * float::sqrt(denominator))
    }

    /// By how much the cosine is less than that of the peak, from `u` in `[0, 1)`.
    #[inline]
    fn sample_from_peak(&self, u: f32) -> f32 {
        let g = self.g.abs();
        // Both numbers of the peak's side: the cosine rises with `u`.
        let (u, rest) = if self.g < 0.0 {
            (1.0 - u, u)
        } else {
            (u, 1.0 - u)
        };
        let narrow = 1.0 - g;
        let share = narrow / (narrow + 2.0 * g * u);
        (2.0 * share * share * rest * (1.0 + g * u)).min(2.0)
    }
}

impl PhaseFunction for HenyeyGreenstein {
    #[inline]
    fn value(&self, cos_theta: f32) -> f32 {
        self.value_from_peak((1.0 - cos_theta * self.g.signum()).max(0.0))
    }

    #[inline]
    fn sample_cos(&self, u: f32) -> f32 {
        (1.0 - self.sample_from_peak(u)) * self.g.signum()
    }

    #[inline]
    fn value_at(&self, deflection: Deflection) -> f32 {
        self.value_from_peak(deflection.distance_from_peak(self.g.signum()))
    }

    #[inline]
    fn sample_deflection(&self, u: f32) -> Deflection {
        Deflection::at_distance_from_peak(self.sample_from_peak(u), self.g.signum())
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

    #[test]
    fn narrow_peaks_keep_their_distribution() {
        use crate::phase::{Phase, tests::check_peak};
        for g in [
            0.0f32, 1e-4, 0.5, -0.5, 0.99, 0.999, -0.999, 0.9999, 0.99999,
        ] {
            let phase = Phase::HenyeyGreenstein(HenyeyGreenstein::new(g).expect("in range"));
            check_peak(phase, g, |from_peak| {
                let g = f64::from(g).abs();
                let root = ((1.0 - g).powi(2) + 2.0 * g * from_peak).sqrt();
                match g {
                    0.0 => 0.5 * from_peak,
                    _ => (1.0 - g * g) / (2.0 * g) * (1.0 / (1.0 - g) - 1.0 / root),
                }
            });
        }
    }
}
