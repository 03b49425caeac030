use crate::alpha_mask::AlphaMask;
use crate::amount::SurfaceAmount;
use crate::color::ColorModel;
use crate::glam::Vec3;
use crate::medium_interface::MediumInterface;
use crate::sides::Sides;
use crate::texture::Texture;
use crate::texture_mapping::TextureMapping;

/// The description of the diffuse emission of a surface of any shape.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct DiffuseEmissionDesc<C: ColorModel> {
    /// Colour of the surface.
    pub color: SurfaceColor<C>,
    /// Amount of light.
    pub amount: SurfaceAmount,
    /// Which sides emit.
    pub sides: Sides,
    /// The emission mask.
    pub mask: EmissionMask,
    /// The mapping of the colour image, and of a mask without a mapping of its own.
    pub mapping: TextureMapping,
    /// The media behind and in front of the surface.
    pub media: MediumInterface,
}

impl<C: ColorModel> DiffuseEmissionDesc<C> {
    /// Emission of the front, without a mask, in vacuum.
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
        /// Multiplies every texel; a luminance is that of white times this.
        tint: Vec3,
    },
}

/// The mask of an emitting surface.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum EmissionMask {
    /// Everywhere.
    #[default]
    Opaque,
    /// An image over the surface parameters. It multiplies the emission, so that no hit is
    /// rejected.
    Alpha(AlphaMask),
    /// Everywhere, but no ray hits the surface: the light has the type
    /// [`DeltaPosition`](crate::LightType::DeltaPosition), and only light samples find it.
    Invisible,
}
