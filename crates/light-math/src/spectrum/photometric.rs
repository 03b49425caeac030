//! Photometric units (lumen, candela, nit, lux) and their conversion to watts.
//!
//! A photometric quantity is the radiometric one weighted by the luminous efficiency `V` of the
//! eye, times [`K_M`]. A light whose spectrum has the shape `s` gives [`luminous`]`(s)` photometric
//! units for each unit of its scale, so the scale that gives what the user asked for is the
//! quotient. The factor of the directions (`4 pi` sr of a point light, `pi` of a Lambertian
//! surface) belongs to the light.
//!
//! In RGB, where white has `Y` = 1 and represents one watt, a colour gives `K_M * Y` photometric
//! units. A spectral picture has the brightness of an RGB picture of the same lamps when its XYZ
//! are integrals over the wavelengths, [`Y_INTEGRAL`](super::cie::Y_INTEGRAL) times the
//! [means](super::cie::xyz).

use super::Spectrum;
pub use super::integrals::{K_M, SpectrumIntegrals};

/// Radiant power, in W.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Watt(pub f32);

/// Luminous power, in lm.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Lumen(pub f32);

/// Luminous intensity, in cd = lm/sr.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Candela(pub f32);

/// Luminance, in cd/m^2 = lm/(sr m^2).
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Nit(pub f32);

/// Illuminance, in lx = lm/m^2.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Lux(pub f32);

impl Lumen {
    /// The power in W of a light of the given efficacy in lm/W.
    #[inline]
    #[must_use]
    pub fn to_watts(self, efficacy: f32) -> f32 {
        self.0 / efficacy
    }
}

impl Candela {
    /// The radiant intensity in W/sr of a light of the given efficacy in lm/W.
    #[inline]
    #[must_use]
    pub fn to_watts_per_sr(self, efficacy: f32) -> f32 {
        self.0 / efficacy
    }
}

impl Nit {
    /// The radiance in W/(sr m^2) of a light of the given efficacy in lm/W.
    #[inline]
    #[must_use]
    pub fn to_radiance(self, efficacy: f32) -> f32 {
        self.0 / efficacy
    }
}

impl Lux {
    /// The irradiance in W/m^2 by a light of the given efficacy in lm/W.
    #[inline]
    #[must_use]
    pub fn to_irradiance(self, efficacy: f32) -> f32 {
        self.0 / efficacy
    }
}

/// A spectral quantity per nm in photometric units: W/nm to lm, W/(sr nm) to cd,
/// and so on.
#[must_use]
pub fn luminous(spectrum: &impl Spectrum) -> f32 {
    spectrum.integrals().luminous
}

/// The integral of a spectral quantity per nm from 360 to 830 nm: W/nm to W, and so on.
#[must_use]
pub fn radiant(spectrum: &impl Spectrum) -> f32 {
    spectrum.integrals().radiant
}

/// The luminous efficacy of radiation of a spectrum, in lm/W: 0 without visible light, 683 at most.
///
/// Only power between 360 and 830 nm counts.
#[must_use]
pub fn efficacy(spectrum: &impl Spectrum) -> f32 {
    let SpectrumIntegrals {
        luminous, radiant, ..
    } = spectrum.integrals();
    if radiant > 0.0 {
        luminous / radiant
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::cie::Y_INTEGRAL;
    use crate::spectrum::{Constant, Daylight, DenselySampled};

    #[test]
    fn one_nanometre_at_the_peak_has_the_maximal_efficacy() {
        let mut values = [0.0; 471];
        values[555 - 360] = 2.0;
        let line = DenselySampled::new(values).expect("valid");
        assert_eq!(efficacy(&line), K_M, "683 lm/W");
        assert_eq!(luminous(&line), 2.0 * K_M, "two watts");
        assert_eq!(radiant(&line), 2.0, "two watts");
    }

    #[test]
    fn equal_energy_has_the_mean_of_the_efficiency() {
        let value = efficacy(&Constant(1.0));
        assert!((value - 683.0 * 106.857 / 470.0).abs() < 0.01, "{value}");
        assert_eq!(radiant(&Constant(1.0)), 470.0, "the width of the range");
        assert!(
            (luminous(&Daylight::D65) / (K_M * Y_INTEGRAL) - 1.0).abs() < 1e-5,
            "scaled to Y = 1"
        );
    }

    #[test]
    fn darkness_has_no_efficacy() {
        assert_eq!(efficacy(&Constant(0.0)), 0.0, "not 0/0");
    }

    #[test]
    fn units_divide_by_the_efficacy() {
        let k = K_M;
        assert_eq!(Lumen(1366.0).to_watts(k), 2.0, "lm");
        assert_eq!(Candela(683.0).to_watts_per_sr(k), 1.0, "cd");
        assert_eq!(Nit(683.0).to_radiance(k), 1.0, "nit");
        assert_eq!(Lux(341.5).to_irradiance(k), 0.5, "lx");
    }
}
