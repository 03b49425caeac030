use crate::alpha_mask::AlphaMask;
use crate::amount::SurfaceAmount;
use crate::color::ColorModel;
use crate::glam::Vec3;
use crate::media::MediumInterface;
use crate::sides::Sides;
use crate::texture::Texture;
use crate::texture_mapping::TextureMapping;

/// How a surface shines, whatever its shape; as a user describes it.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct DiffuseEmissionDesc<C: ColorModel> {
    /// Colour of the surface.
    pub color: SurfaceColor<C>,
    /// How bright it is.
    pub amount: SurfaceAmount,
    /// Which sides emit.
    pub sides: Sides,
    /// Where it emits.
    pub mask: EmissionMask,
    /// How the image of the colour lies on the surface, and the mask that has no mapping of its own.
    pub mapping: TextureMapping,
    /// The media behind and in front of the surface.
    pub media: MediumInterface,
}

impl<C: ColorModel> DiffuseEmissionDesc<C> {
    /// The front shines everywhere, in a vacuum.
    #[must_use]
    pub fn new(color: SurfaceColor<C>, amount: impl Into<SurfaceAmount>) -> Self {
        Self {
            color,
            amount: amount.into(),
            sides: Sides::Front,
            mask: EmissionMask::Opaque,
            mapping: TextureMapping::default(),
            media: MediumInterface::default(),
        }
    }
}

/// The colour of an emitting surface.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub enum SurfaceColor<C: ColorModel> {
    /// The same everywhere.
    Uniform(C::Emission),
    /// An image over the surface parameters.
    Image {
        /// The image; lights that share it hold it once.
        texture: Texture,
        /// Multiplies every texel.
        tint: Vec3,
    },
}

/// Where an emitting surface emits.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum EmissionMask {
    /// Everywhere.
    #[default]
    Opaque,
    /// By an image over the surface parameters. Emission already holds this factor: a ray that
    /// meets the surface counts in full.
    Alpha(AlphaMask),
    /// Everywhere, but no ray meets the surface: the light stays, of type
    /// [`DeltaPosition`](crate::LightType::DeltaPosition), and is found by sampling it alone.
    Invisible,
}
