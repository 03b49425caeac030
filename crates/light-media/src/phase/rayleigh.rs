use super::phase_function::PhaseFunction;
use core::f32::consts::PI;
use light_math::float;

/// Scattering by molecules, much smaller than the wavelength: `3 (1 + cos^2) / (16 pi)`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Rayleigh;

impl PhaseFunction for Rayleigh {
    #[inline]
    fn value(&self, cos_theta: f32) -> f32 {
        3.0 / (16.0 * PI) * (1.0 + cos_theta * cos_theta)
    }

    /// The one real root of the cubic `cos^3 + 3 cos = 8 u - 4`.
    ///
    /// # Source
    /// `[Frisvad2011]`, section 2.
    #[inline]
    fn sample_cos(&self, u: f32) -> f32 {
        let a = 4.0 * u - 2.0;
        // Cardano's larger root, so that nothing cancels; the other root is -1 / r.
        let r = float::cbrt(a.abs() + float::sqrt(a * a + 1.0));
        (r - 1.0 / r).copysign(a).clamp(-1.0, 1.0)
    }
}
