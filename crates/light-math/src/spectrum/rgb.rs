use glam::Vec3;

use super::uplift::{Uplift, strength};
use super::{Daylight, SigmoidPolynomial, Spectrum};

/// A smooth unbounded spectrum of an RGB colour.
///
/// Under the colour space's illuminant it has that colour. It is a factor of an illuminant, or the
/// coefficient of a medium.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RgbUnbounded {
    /// Twice the largest component of the colour.
    scale: f32,
    shape: SigmoidPolynomial,
}

impl RgbUnbounded {
    /// The spectrum of the linear colour `rgb`.
    ///
    /// # Errors
    /// If a component is negative or not finite.
    pub fn new(uplift: &impl Uplift, rgb: Vec3) -> Result<Self, RgbSpectrumError> {
        if !rgb.is_finite() {
            return Err(RgbSpectrumError::NotFinite);
        }
        if rgb.min_element() < 0.0 {
            return Err(RgbSpectrumError::Negative);
        }
        Ok(Self::clamped(uplift, rgb))
    }

    /// The spectrum of the linear colour `rgb` without a check, for texels; negative components and
    /// NaN count as 0.
    #[inline]
    #[must_use]
    pub fn clamped(uplift: &impl Uplift, rgb: Vec3) -> Self {
        Self {
            scale: 2.0 * strength(rgb),
            shape: uplift.shape(rgb),
        }
    }
}

impl Spectrum for RgbUnbounded {
    #[inline]
    fn eval(&self, lambda: f32) -> f32 {
        self.scale * self.shape.eval(lambda)
    }

    fn max_value(&self) -> f32 {
        self.scale * self.shape.max_value()
    }
}

/// The emission of a light by an RGB colour: a smooth spectrum times an illuminant.
///
/// White, `(1, 1, 1)`, is the illuminant itself.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RgbIlluminant {
    rgb: RgbUnbounded,
    illuminant: Daylight,
}

impl RgbIlluminant {
    /// The emission of the linear colour `rgb`; `illuminant` is the one of the colour space that
    /// `uplift` is for.
    ///
    /// # Errors
    /// If a component is negative or not finite.
    pub fn new(
        uplift: &impl Uplift,
        illuminant: Daylight,
        rgb: Vec3,
    ) -> Result<Self, RgbSpectrumError> {
        RgbUnbounded::new(uplift, rgb).map(|rgb| Self { rgb, illuminant })
    }

    /// The emission of the linear colour `rgb` without a check, for texels; negative components and
    /// NaN count as 0.
    #[inline]
    #[must_use]
    pub fn clamped(uplift: &impl Uplift, illuminant: Daylight, rgb: Vec3) -> Self {
        Self {
            rgb: RgbUnbounded::clamped(uplift, rgb),
            illuminant,
        }
    }
}

impl Spectrum for RgbIlluminant {
    #[inline]
    fn eval(&self, lambda: f32) -> f32 {
        self.rgb.eval(lambda) * self.illuminant.eval(lambda)
    }

    /// The product of both bounds: not tight.
    fn max_value(&self) -> f32 {
        self.rgb.max_value() * self.illuminant.max_value()
    }
}

/// Why a colour has no spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RgbSpectrumError {
    /// A component is negative.
    Negative,
    /// A component is infinite or not a number.
    NotFinite,
}

impl core::fmt::Display for RgbSpectrumError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Negative => "a colour's component is negative",
            Self::NotFinite => "a colour's component is not finite",
        })
    }
}

impl core::error::Error for RgbSpectrumError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{RgbColorSpace, UpliftSolver, UpliftTable, cie};
    use proptest::prelude::*;

    #[test]
    fn grey_is_the_illuminant() {
        let grey =
            RgbIlluminant::new(&UpliftTable::SRGB, Daylight::D65, Vec3::splat(0.3)).expect("valid");
        for lambda in [360.0, 450.0, 555.0, 700.0] {
            let expected = 0.3 * Daylight::D65.eval(lambda);
            assert_eq!(grey.eval(lambda), expected, "at {lambda}");
        }
    }

    #[test]
    fn black_is_dark() {
        let black = RgbUnbounded::new(&UpliftTable::SRGB, Vec3::ZERO).expect("black is a colour");
        assert_eq!(
            (black.eval(500.0), black.max_value()),
            (0.0, 0.0),
            "no light"
        );
    }

    #[test]
    fn refuses_what_is_no_colour() {
        let new = |rgb| RgbUnbounded::new(&UpliftTable::SRGB, rgb).err();
        assert_eq!(
            new(Vec3::new(1.0, -1e-6, 0.0)),
            Some(RgbSpectrumError::Negative),
            "negative"
        );
        for bad in [f32::NAN, f32::INFINITY] {
            assert_eq!(
                new(Vec3::new(bad, 0.0, 0.0)),
                Some(RgbSpectrumError::NotFinite),
                "{bad}"
            );
        }
        let clamped = RgbUnbounded::clamped(&UpliftTable::SRGB, Vec3::new(-1.0, f32::NAN, 2.0));
        assert!(clamped.eval(450.0) > 1.0, "only blue is left");
    }

    proptest! {
        #[test]
        fn emission_has_the_colour(rgb in prop::array::uniform3(0.01f32..100.0)) {
            let rgb = Vec3::from(rgb);
            let space = RgbColorSpace::srgb();
            let exact = RgbIlluminant::new(&UpliftSolver::new(&space), space.illuminant(), rgb)
                .expect("valid");
            let fast = RgbIlluminant::clamped(&UpliftTable::SRGB, Daylight::D65, rgb);
            for (emission, tolerance) in [(exact, 4e-4), (fast, 3e-3)] {
                let back = space.rgb_from_xyz() * cie::xyz(&emission);
                let error = back.distance(rgb) / rgb.max_element();
                prop_assert!(error < tolerance, "{} came back as {}", rgb, back);
                let max = 1.0001 * emission.max_value();
                prop_assert!((0..47).all(|i| emission.eval(360.0 + 10.0 * i as f32) <= max));
            }
        }
    }
}
