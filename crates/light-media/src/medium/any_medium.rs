use super::{
    Coefficients, ColorGridMedium, ExponentialHeight, GridMedium, Homogeneous, Majorants, Medium,
};
use crate::phase::Phase;
use crate::ray::{Ray, Span};
use alloc::boxed::Box;
use alloc::vec::Vec;
use light_math::glam::Vec3;
use light_sources::ColorModel;

/// The media of this crate as one value, so that a scene can list them. Grids live in vectors.
#[derive(Clone, Debug)]
#[non_exhaustive]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub enum AnyMedium<C: ColorModel> {
    /// Constant coefficients.
    Homogeneous(Homogeneous<C>),
    /// Exponential falloff of density with height.
    ExponentialHeight(ExponentialHeight<C>),
    /// A density grid.
    Grid(Box<GridMedium<C, Vec<f32>>>),
    /// Grids of coloured coefficients.
    ColorGrid(Box<ColorGridMedium<C, Vec<f32>>>),
}

impl<C: ColorModel> Default for AnyMedium<C>
where
    Homogeneous<C>: Default,
{
    /// Vacuum everywhere.
    fn default() -> Self {
        Self::Homogeneous(Homogeneous::default())
    }
}

/// Calls a method of the medium inside.
macro_rules! for_each_kind {
    ($medium:expr, $it:ident => $answer:expr) => {
        match $medium {
            AnyMedium::Homogeneous($it) => $answer,
            AnyMedium::ExponentialHeight($it) => $answer,
            AnyMedium::Grid($it) => $answer,
            AnyMedium::ColorGrid($it) => $answer,
        }
    };
}

impl<C: ColorModel> Medium<C> for AnyMedium<C> {
    fn phase(&self) -> &Phase {
        for_each_kind!(self, medium => medium.phase())
    }

    fn coefficients(&self, p: Vec3, wavelengths: &C::Wavelengths) -> Coefficients<C::Radiance> {
        for_each_kind!(self, medium => medium.coefficients(p, wavelengths))
    }

    fn clip(&self, ray: &Ray, span: Span) -> Option<Span> {
        for_each_kind!(self, medium => medium.clip(ray, span))
    }

    fn optical_thickness(
        &self,
        ray: &Ray,
        span: Span,
        wavelengths: &C::Wavelengths,
    ) -> Option<C::Radiance> {
        for_each_kind!(self, medium => medium.optical_thickness(ray, span, wavelengths))
    }

    fn majorants(&self, ray: &Ray, span: Span, wavelengths: &C::Wavelengths) -> Majorants<'_> {
        for_each_kind!(self, medium => medium.majorants(ray, span, wavelengths))
    }
}

impl<C: ColorModel> From<Homogeneous<C>> for AnyMedium<C> {
    fn from(medium: Homogeneous<C>) -> Self {
        Self::Homogeneous(medium)
    }
}

impl<C: ColorModel> From<ExponentialHeight<C>> for AnyMedium<C> {
    fn from(medium: ExponentialHeight<C>) -> Self {
        Self::ExponentialHeight(medium)
    }
}

impl<C: ColorModel> From<GridMedium<C, Vec<f32>>> for AnyMedium<C> {
    fn from(medium: GridMedium<C, Vec<f32>>) -> Self {
        Self::Grid(Box::new(medium))
    }
}

impl<C: ColorModel> From<ColorGridMedium<C, Vec<f32>>> for AnyMedium<C> {
    fn from(medium: ColorGridMedium<C, Vec<f32>>) -> Self {
        Self::ColorGrid(Box::new(medium))
    }
}
