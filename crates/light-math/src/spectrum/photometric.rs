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
use super::cie::{LAMBDA_MIN, OBSERVER, SAMPLES};

/// The luminous efficacy of a monochromatic light of 555 nm, in lm/W.
pub const K_M: f32 = 683.0;

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

/// The integrals of a spectral quantity per nm over the wavelengths from 360 to 830 nm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpectrumIntegrals {
    /// In photometric units: W/nm to lm, W/(sr nm) to cd, and so on.
    pub luminous: f32,
    /// In radiometric units: W/nm to W, and so on.
    pub radiant: f32,
}

impl SpectrumIntegrals {
    /// The sum of the trapezoids between whole nanometres.
    pub(super) fn of_nanometres(spectrum: &(impl Spectrum + ?Sized)) -> Self {
        let mut sum = Self::default();
        for (i, observer) in OBSERVER.iter().enumerate() {
            let width = if i == 0 || i == SAMPLES - 1 { 0.5 } else { 1.0 };
            let value = width * spectrum.eval(LAMBDA_MIN + i as f32);
            sum.luminous += value * observer.y;
            sum.radiant += value;
        }
        sum.luminous *= K_M;
        sum
    }

    /// Adds the part from `lambda[0]` to `lambda[1]`, which lie in the range and have no whole
    /// nanometre between them, of a spectrum that is straight there, with a value at either end.
    /// The luminous efficiency is straight between whole nanometres, so that nothing is missed.
    pub(super) fn add_straight(&mut self, lambda: [f32; 2], value: [f32; 2]) {
        let step = lambda[1] - lambda[0];
        let i = whole_nanometre(lambda[0]);
        let [below, above] = [OBSERVER[i].y, OBSERVER[i + 1].y];
        let [a, b] = lambda.map(|lambda| {
            let t = lambda - LAMBDA_MIN - i as f32;
            (1.0 - t) * below + t * above
        });
        let product = value[0] * (2.0 * a + b) + value[1] * (a + 2.0 * b);
        self.luminous += K_M / 6.0 * step * product;
        self.radiant += 0.5 * step * (value[0] + value[1]);
    }
}

/// The nanometre of the table at or below `lambda`, which is not the last one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between 0 and 469"
)]
fn whole_nanometre(lambda: f32) -> usize {
    ((lambda - LAMBDA_MIN).max(0.0) as usize).min(SAMPLES - 2)
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
    let SpectrumIntegrals { luminous, radiant } = spectrum.integrals();
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
