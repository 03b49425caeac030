use core::error::Error;
use core::fmt;

use crate::area::DiffuseAreaLight;
use crate::color::ColorModel;
use crate::diffuse_emission::{DiffuseEmission, DiffuseEmissionError};
use crate::diffuse_emission_desc::DiffuseEmissionDesc;
use crate::glam::Vec3;
use crate::shape::{AnyShape, Shape, ShapeDesc, ShapeError};
use crate::surface_texture::SurfaceTexture;

/// A shape that shines, as a user describes it.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct AreaLightDesc<C: ColorModel> {
    /// What shines.
    pub shape: ShapeDesc,
    /// How it shines.
    pub emission: DiffuseEmissionDesc<C>,
}

/// A shape that shines, as a set keeps it: it becomes a [`DiffuseAreaLight`] when it is looked at.
#[derive(Clone, Debug)]
pub(crate) struct AreaSource<C: ColorModel> {
    shape: AnyShape,
    emission: DiffuseEmission<C>,
    /// Of what varies over the shape.
    mean: Vec3,
}

/// Why a description is no area light; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AreaLightError {
    /// `shape` makes no sense.
    Shape(ShapeError),
    /// `emission` makes no sense.
    Emission(DiffuseEmissionError),
}

impl<C: ColorModel> AreaSource<C> {
    pub(crate) fn new(desc: AreaLightDesc<C>) -> Result<Self, AreaLightError> {
        let shape = desc.shape.build().map_err(AreaLightError::Shape)?;
        let texture = SurfaceTexture::new(&desc.emission);
        let mean = texture.as_ref().map_or(Vec3::ONE, |t| t.mean(&shape));
        let shapes = || core::iter::once((shape.area(), mean));
        let emission = DiffuseEmission::with_means(desc.emission, texture, shapes);
        Ok(Self {
            emission: emission.map_err(AreaLightError::Emission)?,
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
