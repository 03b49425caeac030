use alloc::sync::Arc;
use alloc::vec::Vec;

use crate::channels::Channels;
use crate::glam::{Vec2, Vec3};
use crate::image_error::{ImageError, check_texels};
use crate::rgb_sum::RgbSum;
use crate::texture_mapping::{TextureMapping, Wrap};
#[cfg(feature = "half")]
use half::f16;

/// An image of radiometric values: linear RGB with sRGB's primaries, or one grey channel; finite
/// and not negative.
///
/// Texels are listed row by row from row 0, channels interleaved; texel `(x, y)` covers
/// `[x / width, (x + 1) / width) x [y / height, (y + 1) / height)` of the unit square. They are
/// shared by clones.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Image {
    size: [u32; 2],
    channels: Channels,
    texels: Texels,
}

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
enum Texels {
    Single(Arc<[f32]>),
    #[cfg(feature = "half")]
    Half(Arc<[f16]>),
}

impl Image {
    /// An image of single-precision texels.
    ///
    /// # Errors
    /// When the size is 0 or does not fit `texels`, or a texel is NaN, infinite or negative.
    pub fn from_f32(
        size: [u32; 2],
        channels: Channels,
        texels: impl Into<Arc<[f32]>>,
    ) -> Result<Self, ImageError> {
        let texels = texels.into();
        check_texels(size, channels, texels.len(), |i| texels[i])?;
        Ok(Self {
            size,
            channels,
            texels: Texels::Single(texels),
        })
    }

    /// An image of half-precision texels, half the memory. Needs the feature `half`, whose type is
    /// that of the crate [`half`](crate::half).
    ///
    /// # Errors
    /// When the size is 0 or does not fit `texels`, or a texel is NaN, infinite or negative.
    #[cfg(feature = "half")]
    pub fn from_f16(
        size: [u32; 2],
        channels: Channels,
        texels: impl Into<Arc<[f16]>>,
    ) -> Result<Self, ImageError> {
        let texels = texels.into();
        check_texels(size, channels, texels.len(), |i| texels[i].to_f32())?;
        Ok(Self {
            size,
            channels,
            texels: Texels::Half(texels),
        })
    }

    /// Width and height in texels, both at least 1.
    #[must_use]
    pub const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The channels of a texel.
    #[must_use]
    pub const fn channels(&self) -> Channels {
        self.channels
    }

    /// Bytes of texels, which clones share.
    #[must_use]
    pub fn bytes(&self) -> usize {
        match &self.texels {
            Texels::Single(texels) => size_of_val::<[f32]>(texels),
            #[cfg(feature = "half")]
            Texels::Half(texels) => size_of_val::<[f16]>(texels),
        }
    }

    /// The colour of texel `(x, y)`; beyond the edge, of the texel nearest to it.
    #[inline]
    #[must_use]
    pub fn texel(&self, x: u32, y: u32) -> Vec3 {
        let [width, height] = self.size;
        let (x, y) = (x.min(width - 1), y.min(height - 1));
        let index = y as usize * width as usize + x as usize;
        match &self.texels {
            Texels::Single(texels) => self.channels.color(index, |i| texels[i]),
            #[cfg(feature = "half")]
            Texels::Half(texels) => self.channels.color(index, |i| texels[i].to_f32()),
        }
    }

    /// The texel that holds `uv`; outside of the unit square, the one nearest to it.
    #[inline]
    #[must_use]
    pub fn nearest(&self, uv: Vec2) -> Vec3 {
        let [x, y] = self.texel_at(uv);
        self.texel(x, y)
    }

    /// Column and row of the texel that holds `uv`, as [`nearest`](Self::nearest) finds it.
    #[inline]
    pub(crate) fn texel_at(&self, uv: Vec2) -> [u32; 2] {
        let t = uv * self.extent();
        let [width, height] = self.size;
        [index(t.x).min(width - 1), index(t.y).min(height - 1)]
    }

    /// The colour at `uv`, interpolated between the centres of the four texels around it.
    #[must_use]
    pub fn bilinear(&self, uv: Vec2) -> Vec3 {
        let t = (uv * self.extent() - 0.5).max(Vec2::ZERO);
        let (x, y) = (index(t.x), index(t.y));
        let f = t.fract();
        let top = self
            .texel(x, y)
            .lerp(self.texel(x.saturating_add(1), y), f.x);
        let y1 = y.saturating_add(1);
        let bottom = self
            .texel(x, y1)
            .lerp(self.texel(x.saturating_add(1), y1), f.x);
        top.lerp(bottom, f.y)
    }

    /// The colour at the surface parameters `uv` under `mapping`.
    #[must_use]
    pub fn on_surface(&self, uv: Vec2, mapping: &TextureMapping) -> Vec3 {
        self.bilinear_wrapped(mapping.place(uv), mapping.wrap)
    }

    /// As [`bilinear`](Self::bilinear), with `wrap` beyond the edges.
    #[inline]
    pub(crate) fn bilinear_wrapped(&self, uv: Vec2, wrap: [Wrap; 2]) -> Vec3 {
        let x = wrap[0].around(uv.x, self.size[0]);
        let y = wrap[1].around(uv.y, self.size[1]);
        let at = |x: Option<u32>, y: Option<u32>| match (x, y) {
            (Some(x), Some(y)) => self.texel(x, y),
            _ => Vec3::ZERO,
        };
        let row = |y| at(x.texels[0], y).lerp(at(x.texels[1], y), x.part);
        row(y.texels[0]).lerp(row(y.texels[1]), y.part)
    }

    /// All texels, row by row from row 0: linear RGB, three equal values where the image is grey.
    pub fn texels(&self) -> impl Iterator<Item = Vec3> + '_ {
        let [width, height] = self.size;
        (0..height).flat_map(move |y| (0..width).map(move |x| self.texel(x, y)))
    }

    /// Calls `each` with the colour of every texel of row `y`: faster than single texels where
    /// there are millions.
    pub(crate) fn for_each_in_row(&self, y: u32, each: impl FnMut(Vec3)) {
        let width = self.size[0] as usize * self.channels.count();
        let numbers = y as usize * width..(y as usize + 1) * width;
        match &self.texels {
            Texels::Single(texels) => self.channels.for_each(&texels[numbers], |&x| x, each),
            #[cfg(feature = "half")]
            Texels::Half(texels) => self
                .channels
                .for_each(&texels[numbers], |x| x.to_f32(), each),
        }
    }

    /// The mean colour.
    #[must_use]
    pub fn mean(&self) -> Vec3 {
        let mut sum = RgbSum::default();
        self.texels().for_each(|texel| sum.add(texel, 1.0));
        sum.over(f64::from(self.size[0]) * f64::from(self.size[1]))
    }

    /// The mean over the channels of each texel, row by row: the weights for sampling.
    #[must_use]
    pub fn averages(&self) -> Vec<f32> {
        self.texels().map(|t| t.element_sum() / 3.0).collect()
    }

    /// Address of the texels, the same for clones.
    pub(crate) fn address(&self) -> usize {
        match &self.texels {
            Texels::Single(texels) => texels.as_ptr().addr(),
            #[cfg(feature = "half")]
            Texels::Half(texels) => texels.as_ptr().addr(),
        }
    }

    /// Whether this is a clone of the other image.
    pub(crate) fn is_clone_of(&self, other: &Self) -> bool {
        let layout = |image: &Self| (image.address(), image.size, image.channels);
        layout(self) == layout(other)
    }

    pub(crate) fn extent(&self) -> Vec2 {
        Vec2::new(self.size[0] as f32, self.size[1] as f32)
    }
}

/// The texel index under a coordinate that may lie outside; NaN gives 0.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates, which is the clamp that is wanted"
)]
const fn index(t: f32) -> u32 {
    t as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    fn gray(width: u32, height: u32, texels: &[f32]) -> Result<Image, ImageError> {
        Image::from_f32([width, height], Channels::Gray, texels)
    }

    #[test]
    fn refuses_bad_texels_by_name() {
        let rgb = |bad: f32| {
            let mut texels = [1.0; 12];
            texels[10] = bad;
            Image::from_f32([2, 2], Channels::Rgb, texels)
        };
        let (texel, channel) = ([1, 1], 1);
        assert_eq!(
            rgb(f32::NAN),
            Err(ImageError::NotANumber { texel, channel }),
            "NaN"
        );
        assert_eq!(
            rgb(-1.0),
            Err(ImageError::Negative { texel, channel }),
            "negative"
        );
        let infinite = ImageError::Infinite { texel, channel };
        assert_eq!(rgb(f32::INFINITY), Err(infinite), "infinite");
        assert_eq!(
            infinite.to_string(),
            "texel (1, 1), channel 1: is infinite",
            "named"
        );
        assert_eq!(gray(0, 1, &[]), Err(ImageError::Empty), "empty");
    }

    #[test]
    fn looks_up_texels() {
        let Ok(image) = gray(2, 2, &[0.0, 1.0, 2.0, 3.0]) else {
            unreachable!("good numbers")
        };
        assert_eq!(
            image.nearest(Vec2::new(0.5, 0.49)).x,
            1.0,
            "cells are half open"
        );
        assert_eq!(image.nearest(Vec2::new(1.0, 7.0)).x, 3.0, "clamped");
        assert_eq!(image.bilinear(Vec2::splat(0.5)).x, 1.5, "middle");
        assert_eq!(image.bilinear(Vec2::ZERO).x, 0.0, "corner");
        assert_eq!(image.bilinear(Vec2::ONE).x, 3.0, "corner");
        assert_eq!(image.mean(), Vec3::splat(1.5), "mean");
        assert_eq!(image.averages(), [0.0, 1.0, 2.0, 3.0], "averages");
    }

    #[cfg(feature = "half")]
    #[test]
    fn half_texels_read_as_their_values() {
        let halves: Vec<f16> = [0.25, 0.5, 0.75].map(f16::from_f32).to_vec();
        let image = Image::from_f16([1, 1], Channels::Rgb, halves);
        let Ok(image) = image else {
            unreachable!("good numbers")
        };
        assert_eq!(
            image.texel(0, 0),
            Vec3::new(0.25, 0.5, 0.75),
            "exact in half"
        );
        let mut row = Vec::new();
        image.for_each_in_row(0, |texel| row.push(texel));
        assert_eq!(row, [image.texel(0, 0)], "a row");
        assert_eq!(image.bytes(), 6, "two bytes a number");
    }
}
