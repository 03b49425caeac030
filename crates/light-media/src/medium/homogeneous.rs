use super::{Coefficients, Majorants, Medium, Substance};
use crate::phase::Phase;
use crate::ray::{Ray, Span};
use crate::region::Region;
use light_math::glam::Vec3;
use light_sources::{ColorModel, Radiance};

/// A medium of constant coefficients in its region.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct Homogeneous<C: ColorModel> {
    /// The coefficients.
    pub substance: Substance<C>,
    /// The phase function.
    pub phase: Phase,
    /// The region that it fills.
    pub region: Region,
}

impl<C: ColorModel> Default for Homogeneous<C>
where
    Substance<C>: Default,
{
    /// Vacuum everywhere, with an isotropic phase function.
    fn default() -> Self {
        Self {
            substance: Substance::default(),
            phase: Phase::default(),
            region: Region::default(),
        }
    }
}

impl<C: ColorModel> Medium<C> for Homogeneous<C> {
    fn phase(&self) -> &Phase {
        &self.phase
    }

    fn coefficients(&self, p: Vec3, wavelengths: &C::Wavelengths) -> Coefficients<C::Radiance> {
        if self.region.contains(p) {
            self.substance.at_density(1.0, wavelengths)
        } else {
            Coefficients::VACUUM
        }
    }

    fn clip(&self, ray: &Ray, span: Span) -> Option<Span> {
        self.region.clip(ray, span)
    }

    fn optical_thickness(
        &self,
        _ray: &Ray,
        span: Span,
        wavelengths: &C::Wavelengths,
    ) -> Option<C::Radiance> {
        Some(self.substance.sigma_t(wavelengths) * span.length())
    }

    fn majorants(&self, _ray: &Ray, span: Span, wavelengths: &C::Wavelengths) -> Majorants<'_> {
        // The largest channel; with equal channels no tentative collision is null.
        Majorants::constant(span, self.substance.sigma_t(wavelengths).maximum())
    }
}
