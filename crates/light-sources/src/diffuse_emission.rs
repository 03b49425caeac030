use alloc::sync::Arc;
use alloc::vec::Vec;
use core::error::Error;
use core::f32::consts::PI;
use core::fmt;

use crate::amount::SurfaceAmount;
use crate::color::{ColorModel, Radiance};
use crate::glam::{Vec2, Vec3};
use crate::image::{Channels, Image};
use crate::media::MediumInterface;
use crate::rgb_sum::RgbSum;
use crate::scaled_emission::{EmissionError, ScaledEmission};
use crate::shape::Shape;
use crate::sides::Sides;
use crate::surface_point::SurfacePoint;
use crate::texture::Texture;
use crate::texture_mapping::TextureMapping;
use crate::texture_means::TextureMeans;

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
    /// How the images of colour and mask lie on the surface.
    pub mapping: TextureMapping,
    /// The media behind and in front of the surface.
    pub media: MediumInterface,
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
    /// In proportion to an image over the surface parameters, `[0, 1]`. Emission already holds this factor: a ray that
    /// meets the surface counts in full.
    Alpha(Texture),
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
    mapping: TextureMapping,
    /// Of what varies over the surface: image times alpha. None where nothing does.
    means: Option<Arc<TextureMeans>>,
    media: MediumInterface,
}

#[derive(Clone, Debug)]
enum Color<C: ColorModel> {
    Uniform(ScaledEmission<C>),
    Image {
        texture: Texture,
        tint: Vec3,
        scale: f32,
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

impl<C: ColorModel> DiffuseEmission<C> {
    /// The emission that `desc` describes, for `shapes` that share it: an amount that is a power is that of all of them
    /// together.
    ///
    /// # Errors
    /// When a field of `desc` makes no sense.
    pub fn new(
        desc: DiffuseEmissionDesc<C>,
        shapes: impl IntoIterator<Item = impl Shape>,
    ) -> Result<Self, DiffuseEmissionError> {
        if let EmissionMask::Alpha(texture) = &desc.mask {
            if texture.means().brightest().max_element() > 1.0 {
                return Err(DiffuseEmissionError::Mask);
            }
        }
        let means = means(&desc.color, &desc.mask);
        let mapping = desc.mapping;
        let etendue = || {
            let mut sum = RgbSum::default();
            for shape in shapes {
                let texture = means
                    .as_ref()
                    .map_or(Vec3::ONE, |m| m.over(&shape, &mapping));
                sum.add(texture, f64::from(shape.area()));
            }
            sum.over(1.0) * (PI * desc.sides.count())
        };
        let color = match desc.color {
            SurfaceColor::Uniform(emission) => {
                let radiance = C::flux(&emission);
                let scale = desc.amount.scale(radiance, || radiance * etendue().x)?;
                Color::Uniform(ScaledEmission::new(emission, scale)?)
            }
            SurfaceColor::Image { texture, tint } => {
                if !(tint.is_finite() && tint.min_element() >= 0.0) {
                    return Err(EmissionError::Emission.into());
                }
                let white = C::flux_of_texel(tint);
                let scale = desc
                    .amount
                    .scale(white, || C::flux_of_texel(etendue() * tint))?;
                let brightest = texture.means().brightest() * tint * scale;
                if !(scale >= 0.0 && brightest.is_finite()) {
                    return Err(EmissionError::Amount.into());
                }
                Color::Image {
                    texture,
                    tint,
                    scale,
                }
            }
        };
        Ok(Self {
            means,
            color,
            sides: desc.sides,
            mask: desc.mask,
            mapping,
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
        let shown = |texture: &Texture| texture.image().on_surface(at.uv, &self.mapping);
        let l = match &self.color {
            Color::Uniform(radiance) => radiance.at(wavelengths),
            Color::Image {
                texture,
                tint,
                scale,
            } => C::emit_texel(shown(texture) * *tint, wavelengths) * *scale,
        };
        match &self.mask {
            EmissionMask::Opaque | EmissionMask::Invisible => l,
            EmissionMask::Alpha(texture) => l * shown(texture).x,
        }
    }

    /// Power in W that a shape emits, on all sides.
    #[must_use]
    pub fn phi(&self, shape: &impl Shape, wavelengths: &C::Wavelengths) -> C::Radiance {
        let texture = self.means.as_ref();
        let texture = texture.map_or(Vec3::ONE, |means| means.over(shape, &self.mapping));
        let mean = match &self.color {
            Color::Uniform(radiance) => radiance.at(wavelengths) * texture.x,
            Color::Image { tint, scale, .. } => {
                C::emit_texel(texture * *tint, wavelengths) * *scale
            }
        };
        mean * (PI * self.sides.count() * shape.area())
    }

    /// Power that a shape emits on one side in one number, by which light samplers compare: above 0 unless all of it is
    /// black.
    #[must_use]
    pub fn strength(&self, shape: &impl Shape) -> f32 {
        /// What the points miss, at which the texture is looked at, is about that part of it.
        const MISSED: f32 = 1.0 / 64.0;
        let texture = self.means.as_ref().map_or(Vec3::ONE, |means| {
            let least = MISSED * means.around(shape, &self.mapping);
            means.over(shape, &self.mapping).max(least)
        });
        let mean = match &self.color {
            Color::Uniform(radiance) => radiance.maximum() * texture.x,
            Color::Image { tint, scale, .. } => (texture * *tint).average() * *scale,
        };
        PI * mean * shape.area()
    }

    /// The textures, and the means that belong to none of them.
    pub(crate) fn textures(&self) -> (impl Iterator<Item = &Texture>, Option<&Arc<TextureMeans>>) {
        let color = match &self.color {
            Color::Image { texture, .. } => Some(texture),
            Color::Uniform(_) => None,
        };
        let mask = match &self.mask {
            EmissionMask::Alpha(texture) => Some(texture),
            EmissionMask::Opaque | EmissionMask::Invisible => None,
        };
        let is_product = color.is_some() && mask.is_some();
        let product = self.means.as_ref().filter(|_| is_product);
        (color.into_iter().chain(mask), product)
    }
}

/// The means of image times alpha, which are those of the one that is there; of both they are made anew, on the grid of the
/// image.
fn means<C: ColorModel>(color: &SurfaceColor<C>, mask: &EmissionMask) -> Option<Arc<TextureMeans>> {
    match (color, mask) {
        (SurfaceColor::Image { texture, .. }, EmissionMask::Alpha(alpha)) => {
            let product = product(texture.image(), alpha.image())?;
            Some(Arc::new(TextureMeans::new(product)))
        }
        (SurfaceColor::Image { texture, .. }, _) | (_, EmissionMask::Alpha(texture)) => {
            Some(texture.means().clone())
        }
        (SurfaceColor::Uniform(_), _) => None,
    }
}

/// Each texel of `image` times the value of `alpha` there, which is at most 1.
fn product(image: &Image, alpha: &Image) -> Option<Image> {
    let [width, height] = image.size();
    let extent = Vec2::new(width as f32, height as f32);
    let texel = |x: u32, y: u32| {
        let uv = (Vec2::new(x as f32, y as f32) + 0.5) / extent;
        image.texel(x, y) * alpha.bilinear(uv).x
    };
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let texels = texels.flat_map(|(x, y)| texel(x, y).to_array());
    let texels: Vec<f32> = texels.collect();
    Image::from_f32([width, height], Channels::Rgb, texels).ok()
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
