use core::error::Error;
use core::f32::consts::PI;
use core::fmt;

use crate::color::{ColorModel, Radiance};
use crate::diffuse_emission_desc::{DiffuseEmissionDesc, EmissionMask, SurfaceColor};
use crate::glam::Vec3;
use crate::light_power::{LightPower, PowerColor};
use crate::medium_interface::MediumInterface;
use crate::rgb_sum::RgbSum;
use crate::scaled_emission::{EmissionError, ScaledEmission};
use crate::shape::Shape;
use crate::sides::Sides;
use crate::surface_point::SurfacePoint;
use crate::surface_texture::SurfaceTexture;
use crate::texture::Texture;
use crate::texture_mapping::TextureMapping;
use light_math::float::positive_product;

/// The diffuse emission of a surface of any shape, stored once for all triangles of a mesh.
#[derive(Clone, Debug)]
pub struct DiffuseEmission<C: ColorModel> {
    color: Color<C>,
    sides: Sides,
    mask: EmissionMask,
    mapping: TextureMapping,
    /// The texture, image times alpha; `None` without one.
    texture: Option<SurfaceTexture>,
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

/// Why the description of an emission is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DiffuseEmissionError {
    /// `color` or `amount` is invalid.
    Emission(EmissionError),
    /// `mask` has a scale that is negative or not finite, a cutoff that is no number, or a mapping
    /// that is not finite.
    Mask,
    /// `mapping` has a transform that is not finite.
    Mapping,
}

impl<C: ColorModel> DiffuseEmission<C> {
    /// The emission that `desc` describes, for `shapes` that share it: an amount that is a power is
    /// that of all of them together.
    ///
    /// # Errors
    /// When a field of `desc` is invalid.
    pub fn new(
        desc: DiffuseEmissionDesc<C>,
        shapes: impl IntoIterator<Item = impl Shape>,
    ) -> Result<Self, DiffuseEmissionError> {
        let texture = SurfaceTexture::new(&desc);
        let means = || {
            let mean = |shape: &_| texture.as_ref().map_or(Vec3::ONE, |t| t.mean(shape));
            shapes
                .into_iter()
                .map(move |shape| (shape.area(), mean(&shape)))
        };
        Self::with_means(desc, texture.clone(), means)
    }

    /// As [`new`](Self::new), for shapes of which the areas are known and the means of what varies
    /// over them.
    pub(crate) fn with_means<I: Iterator<Item = (f32, Vec3)>>(
        desc: DiffuseEmissionDesc<C>,
        surface: Option<SurfaceTexture>,
        shapes: impl FnOnce() -> I,
    ) -> Result<Self, DiffuseEmissionError> {
        if !desc.mapping.is_valid() {
            return Err(DiffuseEmissionError::Mapping);
        }
        if let EmissionMask::Alpha(mask) = &desc.mask {
            if !mask.is_valid() {
                return Err(DiffuseEmissionError::Mask);
            }
        }
        let etendue = || {
            let mut sum = RgbSum::default();
            shapes().for_each(|(area, mean)| sum.add(mean, f64::from(area)));
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
                let brightest = texture.brightest() * tint * scale;
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
            texture: surface,
            color,
            sides: desc.sides,
            mask: desc.mask,
            mapping: desc.mapping,
            media: desc.media,
        })
    }

    /// Which sides emit.
    #[must_use]
    pub const fn sides(&self) -> Sides {
        self.sides
    }

    /// Whether rays hit the surface.
    #[must_use]
    pub(crate) const fn is_visible(&self) -> bool {
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
            EmissionMask::Alpha(mask) => l * mask.opacity(at.uv, &self.mapping),
        }
    }

    /// Radiance that leaves every point of the surface on the sides that emit, in W m^-2 sr^-1;
    /// `None` where an image or an alpha mask varies it.
    #[must_use]
    pub fn uniform_radiance(&self, wavelengths: &C::Wavelengths) -> Option<C::Radiance> {
        match (&self.color, &self.mask) {
            (_, EmissionMask::Alpha(_)) | (Color::Image { .. }, _) => None,
            (Color::Uniform(radiance), _) => Some(radiance.at(wavelengths)),
        }
    }

    /// Power in W that a shape emits, on all sides.
    #[must_use]
    pub fn phi(&self, shape: &impl Shape, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.power_of(shape.area(), self.mean(shape))
            .at(wavelengths)
    }

    /// Power that a shape emits on one side as one number for light samplers, that of the brightest
    /// channel or wavelength; above 0 unless the shape is black.
    #[must_use]
    pub fn strength(&self, shape: &impl Shape) -> f32 {
        self.strength_of(shape.area(), self.mean(shape))
    }

    /// The mean of the texture over a shape.
    pub(crate) fn mean(&self, shape: &impl Shape) -> Vec3 {
        let texture = self.texture.as_ref();
        texture.map_or(Vec3::ONE, |texture| texture.mean(shape))
    }

    /// The power of a shape with this area and [`mean`](Self::mean).
    pub(crate) fn power_of(&self, area: f32, mean: Vec3) -> LightPower<'_, C> {
        let (color, scale) = match &self.color {
            Color::Uniform(radiance) => (PowerColor::Emission(radiance), mean.x),
            Color::Image { tint, scale, .. } => (PowerColor::Texel(mean * *tint), *scale),
        };
        LightPower {
            color,
            scale,
            etendue: PI * self.sides.count() * area,
        }
    }

    /// Refuses to emit from a shape whose power is no finite number, taken to be as bright as its
    /// brightest point.
    pub(crate) fn check_power(&self, area: f32) -> Result<(), DiffuseEmissionError> {
        let brightest = match &self.color {
            Color::Uniform(radiance) => radiance.maximum(),
            Color::Image {
                texture,
                tint,
                scale,
            } => (texture.brightest() * *tint).max_element() * *scale,
        };
        let etendue = PI * self.sides.count() * area;
        let is_finite = etendue.is_finite() && (brightest * etendue).is_finite();
        is_finite.then_some(()).ok_or(EmissionError::Power.into())
    }

    /// As [`strength`](Self::strength), of a shape with this area and [`mean`](Self::mean).
    pub(crate) fn strength_of(&self, area: f32, mean: Vec3) -> f32 {
        let radiance = match &self.color {
            Color::Uniform(radiance) => positive_product(radiance.maximum(), mean.x),
            Color::Image { tint, scale, .. } => {
                positive_product((mean * *tint).max_element(), *scale)
            }
        };
        // In this order an intermediate result overflows only if the power does.
        positive_product(radiance, PI * area)
    }

    /// The texture of the surface; `None` without one.
    pub(crate) const fn texture(&self) -> Option<&SurfaceTexture> {
        self.texture.as_ref()
    }
}

impl fmt::Display for DiffuseEmissionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Emission(error) => error.fmt(f),
            Self::Mask => f.write_str(
                "mask: scale must be finite and not negative, cutoff a number, mapping finite",
            ),
            Self::Mapping => f.write_str("mapping: transform must be finite"),
        }
    }
}

impl Error for DiffuseEmissionError {}

impl From<EmissionError> for DiffuseEmissionError {
    fn from(error: EmissionError) -> Self {
        Self::Emission(error)
    }
}
