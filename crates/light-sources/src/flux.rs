use core::ops::Mul;

use light_math::spectrum::Spectrum;
use light_math::spectrum::photometric::SpectrumIntegrals;

/// A photometric and a radiometric quantity of the same light: power, or power per area or solid
/// angle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flux {
    /// In lm, or cd, nit, lx.
    pub luminous: f32,
    /// In W, or W/sr, W m^-2 sr^-1, W m^-2.
    pub radiant: f32,
}

impl Flux {
    /// The integrals of a spectral quantity per nm.
    #[must_use]
    pub fn of_spectrum(spectrum: &impl Spectrum) -> Self {
        let SpectrumIntegrals {
            luminous, radiant, ..
        } = spectrum.integrals();
        Self { luminous, radiant }
    }
}

impl Mul<f32> for Flux {
    type Output = Self;

    fn mul(self, factor: f32) -> Self {
        Self {
            luminous: self.luminous * factor,
            radiant: self.radiant * factor,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_math::spectrum::Constant;

    #[test]
    fn a_constant_has_its_width_in_watts() {
        let flux = Flux::of_spectrum(&Constant(2.0)) * 3.0;
        assert!((flux.radiant - 6.0 * 470.0).abs() < 0.1, "{flux:?}");
        assert!((flux.luminous / flux.radiant - 155.28).abs() < 0.01, "lm/W");
    }
}
