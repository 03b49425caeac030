//! Media: coefficients of absorption, scattering and emission in space.

#[cfg(feature = "alloc")]
mod any_medium;
mod coefficients;
mod color_grid;
mod density_grid;
mod exponential;
mod glow;
mod grid;
mod grid_medium;
mod grid_medium_error;
mod height_bands;
mod homogeneous;
mod majorant;
mod majorant_grid;
#[cfg(feature = "alloc")]
mod temperature;

#[cfg(feature = "alloc")]
pub use any_medium::AnyMedium;
pub use coefficients::{Coefficients, CoefficientsError, Substance};
pub use color_grid::{ColorGrid, ColorGridError, ColorGridMedium};
pub use density_grid::DensityGrid;
pub use exponential::{ExponentialHeight, ExponentialHeightError};
pub use glow::Glow;
pub use grid::{Grid, GridError};
pub use grid_medium::GridMedium;
pub use grid_medium_error::GridMediumError;
pub use homogeneous::Homogeneous;
pub use majorant::{MajorantSegment, Majorants};
#[cfg(feature = "alloc")]
pub use temperature::{Incandescence, TemperatureGrid};

use crate::phase::Phase;
use crate::ray::{Ray, Span};
use light_math::glam::Vec3;
use light_sources::ColorModel;

/// A participating medium. Points, rays and distances are in scene space; coefficients are per
/// scene unit.
pub trait Medium<C: ColorModel> {
    /// The phase function.
    fn phase(&self) -> &Phase;

    /// The coefficients at `p`; all zero outside of the medium.
    fn coefficients(&self, p: Vec3, wavelengths: &C::Wavelengths) -> Coefficients<C::Radiance>;

    /// The part of `span` outside of which the medium is vacuum; `None` when it is empty, as a span
    /// whose ends are not `0 <= t0 < t1` is.
    fn clip(&self, ray: &Ray, span: Span) -> Option<Span>;

    /// The optical thickness, the integral of the extinction over `span`, if it has a closed form.
    /// `span` lies in the medium. The default is `None`.
    fn optical_thickness(
        &self,
        _ray: &Ray,
        _span: Span,
        _wavelengths: &C::Wavelengths,
    ) -> Option<C::Radiance> {
        None
    }

    /// Upper bounds of the extinction over consecutive segments that fill `span`. `span` lies in
    /// the medium.
    fn majorants(&self, ray: &Ray, span: Span, wavelengths: &C::Wavelengths) -> Majorants<'_>;
}
