use super::height_bands::HeightBands;
use super::{Coefficients, Majorants, Medium, Substance};
use crate::phase::Phase;
use crate::ray::{Ray, Span};
use crate::region::Region;
use light_math::glam::Vec3;
use light_math::{direction, float};
use light_sources::ColorModel;

/// A medium with exponential falloff: density 1 up to a base height, above it
/// `exp(-falloff * height)`.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct ExponentialHeight<C: ColorModel> {
    substance: Substance<C>,
    phase: Phase,
    region: Region,
    base: Vec3,
    up: Vec3,
    falloff: f32,
}

/// Why an exponential medium is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ExponentialHeightError {
    /// The base is not finite.
    Base,
    /// The up direction is zero or not finite.
    Up,
    /// The falloff is negative or not finite.
    Falloff,
}

impl<C: ColorModel> ExponentialHeight<C> {
    /// The medium whose density falls above the point `base` of the scene in the direction `up`
    /// (any length), by the factor `e` each `1 / falloff` scene units.
    ///
    /// # Errors
    /// An argument is not finite, `up` is zero or `falloff` negative.
    pub fn new(
        substance: Substance<C>,
        phase: Phase,
        region: Region,
        base: Vec3,
        up: Vec3,
        falloff: f32,
    ) -> Result<Self, ExponentialHeightError> {
        if !base.is_finite() {
            return Err(ExponentialHeightError::Base);
        }
        let up = direction(up).ok_or(ExponentialHeightError::Up)?.normalize();
        if !(falloff >= 0.0 && falloff.is_finite()) {
            return Err(ExponentialHeightError::Falloff);
        }
        Ok(Self {
            substance,
            phase,
            region,
            base,
            up,
            falloff,
        })
    }

    fn height(&self, p: Vec3) -> f32 {
        self.up.dot(p - self.base)
    }

    fn density(&self, height: f32) -> f32 {
        float::exp(-self.falloff * height.max(0.0))
    }

    /// The integral of the density over `span`: linear below the base, an exponential above.
    fn column(&self, ray: &Ray, span: Span) -> f32 {
        let (h0, dh) = (self.height(ray.o), self.up.dot(ray.d));
        if dh == 0.0 {
            return self.density(h0) * span.length();
        }
        let t_base = (-h0 / dh).clamp(span.t0, span.t1);
        let before = Span { t1: t_base, ..span };
        let after = Span { t0: t_base, ..span };
        let (below, above, lowest) = if dh > 0.0 {
            (before, after, after.t0)
        } else {
            (after, before, before.t1)
        };
        below.length()
            + self.density(h0 + dh * lowest) * falling_mass(self.falloff * dh.abs(), above.length())
    }
}

/// The integral of `exp(-rate x)` for x from 0 to `length`.
fn falling_mass(rate: f32, length: f32) -> f32 {
    let x = rate * length;
    if x < 1e-3 {
        // The quotient below would lose digits by cancellation.
        length * (1.0 - 0.5 * x)
    } else {
        (1.0 - float::exp(-x)) / rate
    }
}

impl<C: ColorModel> Medium<C> for ExponentialHeight<C> {
    fn phase(&self) -> &Phase {
        &self.phase
    }

    fn coefficients(&self, p: Vec3, wavelengths: &C::Wavelengths) -> Coefficients<C::Radiance> {
        if !self.region.contains(p) {
            return Coefficients::VACUUM;
        }
        self.substance
            .at_density(self.density(self.height(p)), wavelengths)
    }

    fn clip(&self, ray: &Ray, span: Span) -> Option<Span> {
        self.region.clip(ray, span)
    }

    fn optical_thickness(
        &self,
        ray: &Ray,
        span: Span,
        wavelengths: &C::Wavelengths,
    ) -> Option<C::Radiance> {
        Some(self.substance.sigma_t(wavelengths) * self.column(ray, span))
    }

    fn majorants(&self, ray: &Ray, span: Span, _wavelengths: &C::Wavelengths) -> Majorants<'_> {
        let bands = HeightBands::new(self.falloff, self.height(ray.o), self.up.dot(ray.d), span);
        Majorants::bands(span, self.substance.max_sigma_t(), bands)
    }
}

impl core::fmt::Display for ExponentialHeightError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Base => "the base of an exponential medium must be finite",
            Self::Up => "the up direction of an exponential medium must be finite and not zero",
            Self::Falloff => "the falloff of an exponential medium must be finite and not negative",
        })
    }
}

impl core::error::Error for ExponentialHeightError {}

#[cfg(test)]
mod tests;
