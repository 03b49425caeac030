use core::error::Error;
use core::f32::consts::PI;
use core::fmt;

use crate::amount::SurfaceAmount;
use crate::color::{ColorModel, Radiance};
use crate::glam::{Vec2, Vec3};
use crate::image::Image;
use crate::media::MediumInterface;
use crate::rgb_sum::RgbSum;
use crate::scaled_emission::{EmissionError, ScaledEmission};
use crate::shape::Shape;
use crate::sides::Sides;
use crate::surface_point::SurfacePoint;
use crate::texture_means::TextureMeans;

/// How a surface shines, whatever its shape; as a user describes it.
#[derive(Clone, Debug)]
pub struct DiffuseEmissionDesc<C: ColorModel> {
    /// Colour of the surface.
    pub color: SurfaceColor<C>,
    /// How bright it is.
    pub amount: SurfaceAmount,
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
    /// Of what varies over the surface: image times alpha. None where nothing does.
    means: Option<TextureMeans>,
    media: MediumInterface,
}

#[derive(Clone, Debug)]
enum Color<C: ColorModel> {
    Uniform(ScaledEmission<C>),
    Image { image: Image, scale: f32 },
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
        if let EmissionMask::Alpha(image) = &desc.mask {
            if image.texels().any(|texel| texel.max_element() > 1.0) {
                return Err(DiffuseEmissionError::Mask);
            }
        }
        let means = means(&desc.color, &desc.mask);
        let etendue = || {
            let mut sum = RgbSum::default();
            for shape in shapes {
                let texture = texture_over(means.as_ref(), &shape);
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
            SurfaceColor::Image(image) => {
                let white = C::flux_of_texel(Vec3::ONE);
                let scale = desc.amount.scale(white, || C::flux_of_texel(etendue()))?;
                let brightest = image.texels().map(Vec3::max_element).fold(0.0, f32::max);
                if !(scale >= 0.0 && (brightest * scale).is_finite()) {
                    return Err(EmissionError::Amount.into());
                }
                Color::Image { image, scale }
            }
        };
        Ok(Self {
            means,
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
            Color::Image { image, scale } => {
                C::emit_texel(image.bilinear(uv), wavelengths) * *scale
            }
        };
        match &self.mask {
            EmissionMask::Opaque | EmissionMask::Invisible => l,
            EmissionMask::Alpha(alpha) => l * alpha.bilinear(uv).x,
        }
    }

    /// Power in W that a shape emits, on all sides.
    #[must_use]
    pub fn phi(&self, shape: &impl Shape, wavelengths: &C::Wavelengths) -> C::Radiance {
        let texture = texture_over(self.means.as_ref(), shape);
        let mean = match &self.color {
            Color::Uniform(radiance) => radiance.at(wavelengths) * texture.x,
            Color::Image { scale, .. } => C::emit_texel(texture, wavelengths) * *scale,
        };
        mean * (PI * self.sides.count() * shape.area())
    }

    /// Power that a shape emits on one side in one number, by which light samplers compare.
    #[must_use]
    pub fn strength(&self, shape: &impl Shape) -> f32 {
        let texture = texture_over(self.means.as_ref(), shape);
        let mean = match &self.color {
            Color::Uniform(radiance) => radiance.maximum() * texture.x,
            Color::Image { scale, .. } => texture.average() * *scale,
        };
        PI * mean * shape.area()
    }
}

/// The mean over a shape of what varies over it, 1 where nothing does.
fn texture_over(means: Option<&TextureMeans>, shape: &impl Shape) -> Vec3 {
    means.map_or(Vec3::ONE, |means| means.over(shape))
}

/// The means of image times alpha, on the grid of the one that is there.
fn means<C: ColorModel>(color: &SurfaceColor<C>, mask: &EmissionMask) -> Option<TextureMeans> {
    let (size, texels) = match (color, mask) {
        (SurfaceColor::Image(image), EmissionMask::Alpha(alpha)) => {
            let [width, height] = image.size();
            let extent = Vec2::new(width as f32, height as f32);
            let at = |i: u32| Vec2::new((i % width) as f32, (i / width) as f32) + 0.5;
            let texels = (0..).zip(image.texels());
            let texels = texels.map(|(i, texel)| texel * alpha.bilinear(at(i) / extent).x);
            (image.size(), texels.collect())
        }
        (SurfaceColor::Image(image), _) => (image.size(), image.texels().collect()),
        (SurfaceColor::Uniform(_), EmissionMask::Alpha(alpha)) => {
            (alpha.size(), alpha.texels().collect())
        }
        (SurfaceColor::Uniform(_), _) => return None,
    };
    Some(TextureMeans::new(size, texels))
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
