use alloc::vec::Vec;

use crate::glam::Vec3;
use crate::image::Image;
use crate::image_error::ImageError;
use crate::rgb_sum::RgbSum;
use light_math::float::sin;
use light_math::{Resampler, SphereImage, SphereImageError, SphereMap};

/// Sums of many texels that are not brighter are finite.
const BRIGHT: f32 = 1e30;

/// What brighter images are multiplied by while they are summed, a power of two: 2^-40.
const DIMMED: f32 = 1.0 / (1u64 << 40) as f32;

impl Image {
    /// Resamples this image of the sphere from the map `from` to another map and size.
    ///
    /// Each channel keeps its integral over the sphere, which matters for small suns. For the same
    /// map and size this is a clone.
    ///
    /// # Errors
    /// When a side is 0, an equal-area image is not square, or a texel of the result would be
    /// infinite.
    pub fn resampled(
        &self,
        from: SphereMap,
        to: SphereMap,
        size: [u32; 2],
    ) -> Result<Self, ImageError> {
        // The sum over a texel's directions shall be finite.
        let brightest = self.texels().map(Vec3::max_element).fold(0.0, f32::max);
        let dimmed = if brightest > BRIGHT { DIMMED } else { 1.0 };
        let source = |x, y| self.texel(x, y) * dimmed;
        let resampler = SphereImage::new(from, self.size(), source)
            .and_then(|source| Resampler::new(source, to, size))
            .map_err(|error| match error {
                SphereImageError::NotSquare => ImageError::NotSquare,
                _ => ImageError::Empty,
            })?;
        if (from, self.size()) == (to, size) {
            return Ok(self.clone());
        }
        let texels: Vec<Vec3> = resampler.texels().collect();
        let have = sphere_mean(to, size, texels.iter().copied());
        let ratio = self.sphere_mean(from) / have;
        let ratio = Vec3::select(have.cmpgt(Vec3::ZERO), ratio, Vec3::ONE);
        let channels = self.channels();
        let numbers = texels.iter().flat_map(|&texel| {
            let numbers = (texel * ratio).to_array();
            numbers.into_iter().take(channels.count())
        });
        Self::from_f32(size, channels, numbers.collect::<Vec<_>>())
    }

    /// The mean of this image over the sphere, under `map`.
    #[must_use]
    pub(crate) fn sphere_mean(&self, map: SphereMap) -> Vec3 {
        sphere_mean(map, self.size(), self.texels())
    }
}

/// Rows and columns of the equal-area image whose texels are as large as those at the horizon of a
/// latitude-longitude image of this height.
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "positive, and not far above the height"
)]
pub fn equal_area_size(height: u32) -> u32 {
    // n^2 texels of 4 pi / n^2 sr against (pi / height)^2 sr.
    (f64::from(height) * core::f64::consts::FRAC_2_SQRT_PI + 0.5) as u32
}

/// The mean over the sphere of texels, row by row.
fn sphere_mean(
    map: SphereMap,
    [width, height]: [u32; 2],
    mut texels: impl Iterator<Item = Vec3>,
) -> Vec3 {
    let half_row = core::f32::consts::FRAC_PI_2 / height as f32;
    let (mut sum, mut total) = (RgbSum::default(), 0.0);
    for y in 0..height {
        let weight = match map {
            SphereMap::EqualArea => 1.0,
            // Up to a factor, the difference of the cosines at both edges of the row.
            SphereMap::LatLong => f64::from(sin(half_row * (2 * y + 1) as f32)),
        };
        for texel in texels.by_ref().take(width as usize) {
            sum.add(texel, weight);
            total += weight;
        }
    }
    sum.over(total)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::channels::Channels;

    #[test]
    fn light_is_kept_both_ways() -> Result<(), ImageError> {
        // A dim sky and a sun of a single texel.
        let mut texels = alloc::vec![0.1; 64 * 32];
        texels[64 * 9 + 40] = 5000.0;
        let image = Image::from_f32([64, 32], Channels::Gray, texels)?;
        let mean = image.sphere_mean(SphereMap::LatLong).x;
        let n = equal_area_size(32);
        let square = image.resampled(SphereMap::LatLong, SphereMap::EqualArea, [n, n])?;
        assert!((square.mean().x / mean - 1.0).abs() < 1e-5, "there");
        let back = square.resampled(SphereMap::EqualArea, SphereMap::LatLong, [64, 32])?;
        let again = back.sphere_mean(SphereMap::LatLong).x;
        assert!((again / mean - 1.0).abs() < 1e-5, "and back");
        assert_eq!(n, 36, "32 * 2 / sqrt(pi)");
        Ok(())
    }

    #[test]
    fn the_same_map_and_size_change_nothing() -> Result<(), ImageError> {
        let texels: Vec<f32> = (0..8u8).map(f32::from).collect();
        let image = Image::from_f32([4, 2], Channels::Gray, texels)?;
        let same = image.resampled(SphereMap::LatLong, SphereMap::LatLong, [4, 2])?;
        assert!(same.is_clone_of(&image), "each texel as it is");
        Ok(())
    }

    /// The directions in a texel together are brighter than any number.
    #[test]
    fn the_brightest_images_stay_as_they_are() -> Result<(), ImageError> {
        let image = Image::from_f32([8, 4], Channels::Gray, [2e38; 32])?;
        let square = image.resampled(SphereMap::LatLong, SphereMap::EqualArea, [4, 4])?;
        let back = square.resampled(SphereMap::EqualArea, SphereMap::LatLong, [8, 4])?;
        for texel in square.texels().chain(back.texels()) {
            assert!((texel.x / 2e38 - 1.0).abs() < 1e-5, "{texel}");
        }
        Ok(())
    }

    #[test]
    fn refuses_sizes_that_are_none() -> Result<(), ImageError> {
        let image = Image::from_f32([2, 1], Channels::Gray, [1.0, 2.0])?;
        let to = |map, size| image.resampled(SphereMap::LatLong, map, size).err();
        assert_eq!(
            to(SphereMap::LatLong, [0, 1]),
            Some(ImageError::Empty),
            "empty"
        );
        assert_eq!(
            to(SphereMap::EqualArea, [2, 1]),
            Some(ImageError::NotSquare),
            "not square"
        );
        let square = image.resampled(SphereMap::EqualArea, SphereMap::LatLong, [2, 1]);
        assert_eq!(
            square.err(),
            Some(ImageError::NotSquare),
            "the source is not square"
        );
        Ok(())
    }
}
