use core::error::Error;
use core::fmt;

use crate::area::DiffuseAreaLight;
use crate::color::ColorModel;
use crate::diffuse_emission::{DiffuseEmission, DiffuseEmissionError};
use crate::diffuse_emission_desc::DiffuseEmissionDesc;
use crate::glam::Vec3;
use crate::shape::{AnyShape, Shape, ShapeDesc, ShapeError};
use crate::surface_texture::SurfaceTexture;

/// The description of an area light.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct AreaLightDesc<C: ColorModel> {
    /// The surface.
    pub shape: ShapeDesc,
    /// The emission of the surface.
    pub emission: DiffuseEmissionDesc<C>,
}

impl<C: ColorModel> AreaLightDesc<C> {
    /// A surface and its emission.
    #[must_use]
    pub const fn new(shape: ShapeDesc, emission: DiffuseEmissionDesc<C>) -> Self {
        Self { shape, emission }
    }
}

/// An area light as a set stores it; accessors make a [`DiffuseAreaLight`] of it.
#[derive(Clone, Debug)]
pub(crate) struct AreaSource<C: ColorModel> {
    shape: AnyShape,
    emission: DiffuseEmission<C>,
    /// The mean of the texture over the shape, if there is one.
    mean: Vec3,
}

/// Why the description of an area light is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AreaLightError {
    /// `shape` is invalid.
    Shape(ShapeError),
    /// `emission` is invalid.
    Emission(DiffuseEmissionError),
}

impl<C: ColorModel> AreaSource<C> {
    pub(crate) fn new(desc: AreaLightDesc<C>) -> Result<Self, AreaLightError> {
        let shape = desc.shape.build().map_err(AreaLightError::Shape)?;
        let texture = SurfaceTexture::new(&desc.emission);
        let mean = texture.as_ref().map_or(Vec3::ONE, |t| t.mean(&shape));
        let shapes = || core::iter::once((shape.area(), mean));
        let emission = DiffuseEmission::with_means(desc.emission, texture, shapes);
        let emission = emission.map_err(AreaLightError::Emission)?;
        let check = emission.check_power(shape.area());
        check.map_err(AreaLightError::Emission)?;
        Ok(Self {
            emission,
            shape,
            mean,
        })
    }

    pub(crate) const fn light(&self) -> DiffuseAreaLight<'_, C, &AnyShape> {
        DiffuseAreaLight::with_mean(&self.shape, &self.emission, Some(&self.mean))
    }
}

impl fmt::Display for AreaLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shape(error) => error.fmt(f),
            Self::Emission(error) => error.fmt(f),
        }
    }
}

impl Error for AreaLightError {}
