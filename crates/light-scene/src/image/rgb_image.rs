use alloc::sync::Arc;
use core::fmt;

use lights::sources::{self as sources, Channels};

use super::srgb::encode_byte;
use crate::glam::{DVec3, Vec3};

/// A linear RGB image in memory, row 0 on top.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Image {
    width: u32,
    height: u32,
    texels: Vec<Vec3>,
}

/// Why an image is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ImageError {
    /// Width or height is 0.
    Empty,
    /// There are not width times height texels.
    TexelCount,
}

impl Image {
    /// An image of `width * height` texels, row by row from the top, each row from the left.
    ///
    /// # Errors
    /// When width or height is 0, or the number of texels is not their product.
    pub fn new(width: u32, height: u32, texels: Vec<Vec3>) -> Result<Self, ImageError> {
        if width == 0 || height == 0 {
            return Err(ImageError::Empty);
        }
        if (width as usize).checked_mul(height as usize) != Some(texels.len()) {
            return Err(ImageError::TexelCount);
        }
        Ok(Self {
            width,
            height,
            texels,
        })
    }

    /// Texels per row, at least 1.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Rows, at least 1.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// Texels per row, and rows.
    pub(crate) const fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// All texels, row by row from the top.
    #[must_use]
    pub fn texels(&self) -> &[Vec3] {
        &self.texels
    }

    /// All texels, row by row from the top, without the frame around them.
    #[must_use]
    pub fn into_texels(self) -> Vec<Vec3> {
        self.texels
    }

    /// The texels as a screen shows them: bytes of sRGB, clamped; NaN becomes black.
    ///
    /// # Source
    /// IEC 61966-2-1.
    #[must_use]
    pub fn to_srgb(&self) -> Vec<[u8; 3]> {
        let texels = self.texels.iter();
        texels.map(|t| t.to_array().map(encode_byte)).collect()
    }

    /// The mean of all texels.
    #[must_use]
    pub fn mean(&self) -> Vec3 {
        let sum: DVec3 = self.texels.iter().map(|texel| texel.as_dvec3()).sum();
        (sum / self.texels.len() as f64).as_vec3()
    }

    /// The image as lights hold it: with one channel where all three are alike.
    ///
    /// # Errors
    /// When a texel is negative or not finite.
    pub fn to_light(&self) -> Result<sources::Image, sources::ImageError> {
        let size = [self.width, self.height];
        let texels = self.texels.iter();
        if self.texels.iter().all(|t| t.x == t.y && t.y == t.z) {
            let texels: Arc<[f32]> = texels.map(|t| t.x).collect();
            return sources::Image::from_f32(size, Channels::Gray, texels);
        }
        let texels: Arc<[f32]> = texels.flat_map(|t| t.to_array()).collect();
        sources::Image::from_f32(size, Channels::Rgb, texels)
    }

    /// The texel of column `x` and row `y`.
    ///
    /// # Panics
    /// Panics outside the image.
    #[must_use]
    pub fn texel(&self, x: u32, y: u32) -> Vec3 {
        assert!(x < self.width && y < self.height, "texel inside the image");
        self.texels[y as usize * self.width as usize + x as usize]
    }
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Empty => "an image needs at least one texel in each direction",
            Self::TexelCount => "the number of texels is not width times height",
        })
    }
}

impl core::error::Error for ImageError {}
