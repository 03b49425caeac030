use core::fmt::Debug;
use core::ops::{Add, Mul};

use crate::flux::Flux;
use crate::glam::Vec3;

/// The result of a light query: a radiance, or another radiometric quantity, with one number per
/// colour channel or sampled wavelength.
pub trait Radiance:
    Copy
    + Debug
    + PartialEq
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Mul<Output = Self>
    + Mul<f32, Output = Self>
{
    /// No light.
    const BLACK: Self;

    /// The same value in every component.
    fn splat(value: f32) -> Self;

    /// `f` of every component.
    #[must_use]
    fn map(self, f: impl Fn(f32) -> f32) -> Self;

    /// Whether every component is 0.
    fn is_black(self) -> bool;

    /// The mean of the components.
    fn average(self) -> f32;

    /// The largest component.
    fn maximum(self) -> f32;
}

/// A colour model as a type: what a light stores, what a query carries and what it returns.
///
/// Every light is written once, over this trait. A renderer that works in RGB compiles no spectral
/// code.
pub trait ColorModel: Copy + Debug + Send + Sync + 'static {
    /// What a query carries: `()`, or the sampled wavelengths.
    type Wavelengths: Copy + Debug + Send + Sync;

    /// What a light stores. Spectra with tables share them, so a clone is cheap.
    type Emission: Clone + Debug + Send + Sync;

    /// The result of a query.
    type Radiance: Radiance;

    /// The value of a stored emission.
    fn emit(emission: &Self::Emission, wavelengths: &Self::Wavelengths) -> Self::Radiance;

    /// The value of an image texel, linear RGB with sRGB's primaries, as a light source.
    fn emit_texel(rgb: Vec3, wavelengths: &Self::Wavelengths) -> Self::Radiance;

    /// The largest value of an emission over all channels or wavelengths.
    fn maximum(emission: &Self::Emission) -> f32;

    /// Whether an emission is finite and nowhere negative.
    fn is_valid(emission: &Self::Emission) -> bool;

    /// The luminous and the radiant flux of an emission.
    fn flux(emission: &Self::Emission) -> Flux;

    /// The luminous and the radiant flux of an image texel.
    fn flux_of_texel(rgb: Vec3) -> Flux;

    /// Fixed wavelengths at which lights are compared with one another.
    fn reference_wavelengths() -> Self::Wavelengths;

    /// One number for a value that was taken at `wavelengths`: its mean over the channels or over
    /// the spectrum.
    fn mean(value: Self::Radiance, wavelengths: &Self::Wavelengths) -> f32;
}
