use core::error::Error;
use core::f32::consts::PI;
use core::fmt;

use crate::amount::RadianceAmount;
use crate::color::{ColorModel, Radiance};
use crate::glam::{Vec2, Vec3};
use crate::image::Image;
use crate::media::MediumInterface;
use crate::scaled_emission::{EmissionError, ScaledEmission};
use crate::sides::Sides;
use crate::surface_point::SurfacePoint;

/// How a surface shines, whatever its shape; as a user describes it.
#[derive(Clone, Debug)]
pub struct DiffuseEmissionDesc<C: ColorModel> {
    /// Colour of the surface.
    pub color: SurfaceColor<C>,
    /// How bright it is.
    pub amount: RadianceAmount,
    /// Which sides emit.
    pub sides: Sides,
    /// Where it emits.
    pub mask: EmissionMask,
    /// The media behind and in front of the surface.
    pub media: MediumInterface,
}

/// The colour of an emitting surface.
#[derive(Clone, Debug)]
pub enum SurfaceColor<C: ColorModel> {
    /// The same everywhere.
    Uniform(C::Emission),
    /// An image over the surface parameters; its row 0 lies at v = 1.
    Image(Image),
}

/// Where an emitting surface emits.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum EmissionMask {
    /// Everywhere.
    #[default]
    Opaque,
    /// In proportion to an image over the surface parameters, `[0, 1]`; its row 0 lies at v = 1. Emission already
    /// holds this factor: a ray that meets the surface counts in full.
    Alpha(Image),
    /// Everywhere, but no ray meets the surface: the light stays, of type
    /// [`DeltaPosition`](crate::LightType::DeltaPosition), and is found by sampling it alone.
    Invisible,
}

/// How a surface shines, whatever its shape: stored once for all triangles of a mesh.
#[derive(Clone, Debug)]
pub struct DiffuseEmission<C: ColorModel> {
    color: Color<C>,
    sides: Sides,
    mask: EmissionMask,
    media: MediumInterface,
}

#[derive(Clone, Debug)]
enum Color<C: ColorModel> {
    Uniform(ScaledEmission<C>),
    Image {
        image: Image,
        scale: f32,
        mean: Vec3,
    },
}

/// Why a description is no emission; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DiffuseEmissionError {
    /// `color` or `amount` makes no sense.
    Emission(EmissionError),
    /// `mask` has a texel above 1.
    Mask,
}

impl<C: ColorModel> DiffuseEmissionDesc<C> {
    /// The front shines everywhere, in a vacuum.
    #[must_use]
    pub fn new(color: SurfaceColor<C>, amount: RadianceAmount) -> Self {
        Self {
            color,
            amount,
            sides: Sides::Front,
            mask: EmissionMask::Opaque,
            media: MediumInterface::default(),
        }
    }
}

impl<C: ColorModel> DiffuseEmission<C> {
    /// The emission that `desc` describes.
    ///
    /// # Errors
    /// When a field of `desc` makes no sense.
    pub fn new(desc: DiffuseEmissionDesc<C>) -> Result<Self, DiffuseEmissionError> {
        let RadianceAmount::Radiometric(scale) = desc.amount;
        let color = match desc.color {
            SurfaceColor::Uniform(emission) => {
                Color::Uniform(ScaledEmission::new(emission, scale)?)
            }
            SurfaceColor::Image(image) => {
                let mean = image.mean();
                if !(scale >= 0.0 && (mean * scale).is_finite()) {
                    return Err(EmissionError::Amount.into());
                }
                Color::Image { image, scale, mean }
            }
        };
        if let EmissionMask::Alpha(image) = &desc.mask {
            if image.texels().any(|texel| texel.max_element() > 1.0) {
                return Err(DiffuseEmissionError::Mask);
            }
        }
        Ok(Self {
            color,
            sides: desc.sides,
            mask: desc.mask,
            media: desc.media,
        })
    }

    /// Which sides emit.
    #[must_use]
    pub const fn sides(&self) -> Sides {
        self.sides
    }

    /// Whether rays meet the surface.
    #[must_use]
    pub const fn is_visible(&self) -> bool {
        !matches!(self.mask, EmissionMask::Invisible)
    }

    /// The media behind and in front of the surface.
    #[must_use]
    pub const fn media(&self) -> MediumInterface {
        self.media
    }

    /// Radiance that leaves the surface at `at` in direction `w`, in W m^-2 sr^-1.
    #[inline]
    #[must_use]
    pub fn l(&self, at: &SurfacePoint, w: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        if !self.sides.emit_toward(at.n, w) {
            return C::Radiance::BLACK;
        }
        let uv = Vec2::new(at.uv.x, 1.0 - at.uv.y);
        let l = match &self.color {
            Color::Uniform(radiance) => radiance.at(wavelengths),
            Color::Image { image, scale, .. } => {
                C::emit_texel(image.bilinear(uv), wavelengths) * *scale
            }
        };
        match &self.mask {
            EmissionMask::Opaque | EmissionMask::Invisible => l,
            EmissionMask::Alpha(alpha) => l * alpha.bilinear(uv).x,
        }
    }

    /// Power per area in W m^-2, over all sides.
    #[must_use]
    pub fn exitance(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        let mean = match &self.color {
            Color::Uniform(radiance) => radiance.at(wavelengths),
            Color::Image { scale, mean, .. } => C::emit_texel(*mean, wavelengths) * *scale,
        };
        mean * (PI * self.sides.count())
    }

    /// Power per area and side in one number, by which light samplers compare.
    #[must_use]
    pub fn strength(&self) -> f32 {
        PI * match &self.color {
            Color::Uniform(radiance) => radiance.maximum(),
            Color::Image { scale, mean, .. } => mean.average() * *scale,
        }
    }
}

impl fmt::Display for DiffuseEmissionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Emission(error) => error.fmt(f),
            Self::Mask => f.write_str("mask: alpha must lie in [0, 1]"),
        }
    }
}

impl Error for DiffuseEmissionError {}

impl From<EmissionError> for DiffuseEmissionError {
    fn from(error: EmissionError) -> Self {
        Self::Emission(error)
    }
}
