use crate::glam::Vec2;
use crate::image::Image;
use crate::mask_share::MaskShare;
use crate::texture::Texture;
use crate::texture_mapping::TextureMapping;

/// Which part of a surface emits, by an image.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct AlphaMask {
    /// The image, of which the first channel counts; lights that share it hold it once.
    pub texture: Texture,
    /// Multiplies every texel: alpha. Finite and not negative.
    pub scale: f32,
    /// How the image lies on the surface; absent: as the image of the colour.
    pub mapping: Option<TextureMapping>,
    /// The surface emits where alpha is at least this, and nowhere else. Absent: it emits in
    /// proportion to alpha, and in full where that is above 1.
    pub cutoff: Option<f32>,
}

/// What a mask does to the mean of a surface: a share by the texels, times a factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MaskRule {
    pub(crate) share: MaskShare,
    pub(crate) factor: f32,
}

impl AlphaMask {
    /// How much of the surface emits where its parameters are `uv`, in `[0, 1]`; `mapping` is that
    /// of the image of the colour.
    #[inline]
    #[must_use]
    pub fn opacity(&self, uv: Vec2, mapping: &TextureMapping) -> f32 {
        let mapping = self.mapping.as_ref().unwrap_or(mapping);
        let alpha = self.texture.image().on_surface(uv, mapping).x * self.scale;
        match self.cutoff {
            Some(cutoff) => f32::from(u8::from(alpha >= cutoff)),
            None => alpha.min(1.0),
        }
    }

    pub(crate) fn is_valid(&self) -> bool {
        let is_number = self.cutoff.is_none_or(|cutoff| !cutoff.is_nan());
        let is_mapped = self.mapping.is_none_or(|mapping| mapping.is_valid());
        self.scale.is_finite() && self.scale >= 0.0 && is_number && is_mapped
    }

    /// How its texels count; `None` where the surface emits everywhere.
    ///
    /// The cutoff is lowered by more than the rounding of [`opacity`](Self::opacity), so that every
    /// point that emits counts.
    pub(crate) fn rule(&self) -> Option<MaskRule> {
        let scale = f64::from(self.scale);
        let linear = |factor| MaskRule {
            share: MaskShare::Linear,
            factor,
        };
        let Some(cutoff) = self.cutoff else {
            let is_linear = self.texture.brightest().x * self.scale <= 1.0;
            let share = MaskShare::AtMostOne(scale);
            let clamped = MaskRule { share, factor: 1.0 };
            return Some(if is_linear {
                linear(self.scale)
            } else {
                clamped
            });
        };
        let least = f64::from(cutoff) * (1.0 - 1e-6) - f64::from(f32::MIN_POSITIVE);
        if least <= 0.0 {
            return None;
        }
        let share = MaskShare::Cutoff(least / scale);
        Some(MaskRule { share, factor: 1.0 })
    }
}

impl From<Texture> for AlphaMask {
    /// In proportion to the texels, which lie as the image of the colour.
    fn from(texture: Texture) -> Self {
        Self {
            texture,
            scale: 1.0,
            mapping: None,
            cutoff: None,
        }
    }
}

impl From<Image> for AlphaMask {
    fn from(image: Image) -> Self {
        Texture::new(image).into()
    }
}
