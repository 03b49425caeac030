//! Environment maps from one square to the other: the latitude-longitude map that users own, the equal-area map that
//! lights sample.

use alloc::vec::Vec;

use crate::glam::Vec3;
use crate::image::{Channels, Image, ImageError};
use crate::rgb_sum::RgbSum;
use light_math::float::sin;
use light_math::{Resampler, SphereImage, SphereImageError, SphereMap};

/// The equal-area image of `n` x `n` texels, at least 1, that a latitude-longitude image becomes.
///
/// Texels are means over directions spread evenly in them ([`Resampler`]). Then each channel is scaled so that the light of
/// the whole sphere stays what it was: small suns would gain or lose otherwise.
///
/// # Errors
/// When `n` is 0.
pub fn lat_long_to_equal_area(image: &Image, n: u32) -> Result<Image, ImageError> {
    let texels = resample(image, SphereMap::LatLong, SphereMap::EqualArea, [n, n])?;
    let mut sum = RgbSum::default();
    texels.iter().for_each(|&texel| sum.add(texel, 1.0));
    let mean = sum.over(f64::from(n) * f64::from(n));
    finish(
        [n, n],
        image.channels(),
        &texels,
        mean,
        lat_long_mean(image.size(), |x, y| image.texel(x, y)),
    )
}

/// The latitude-longitude image of the given size that an equal-area image becomes, in the same way.
///
/// # Errors
/// When the size is 0, or the image is not square.
pub fn equal_area_to_lat_long(image: &Image, size: [u32; 2]) -> Result<Image, ImageError> {
    let texels = resample(image, SphereMap::EqualArea, SphereMap::LatLong, size)?;
    let mean = lat_long_mean(size, |x, y| texels[(y * size[0] + x) as usize]);
    finish(size, image.channels(), &texels, mean, image.mean())
}

/// Rows and columns that keep the solid angle of a texel at the horizon of a latitude-longitude image of this height.
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

/// The texels of an image, row by row, in another map and size.
fn resample(
    image: &Image,
    from: SphereMap,
    to: SphereMap,
    size: [u32; 2],
) -> Result<Vec<Vec3>, ImageError> {
    SphereImage::new(from, image.size(), |x, y| image.texel(x, y))
        .and_then(|source| Resampler::new(source, to, size))
        .map(|resampler| resampler.texels().collect())
        .map_err(|error| match error {
            SphereImageError::NotSquare => ImageError::NotSquare,
            _ => ImageError::Empty,
        })
}

/// The image of `texels`, whose mean over the sphere becomes `wanted`.
fn finish(
    size: [u32; 2],
    channels: Channels,
    texels: &[Vec3],
    mean: Vec3,
    wanted: Vec3,
) -> Result<Image, ImageError> {
    let ratio = Vec3::select(mean.cmpgt(Vec3::ZERO), wanted / mean, Vec3::ONE);
    let numbers: Vec<f32> = texels
        .iter()
        .flat_map(|&texel| {
            (texel * ratio)
                .to_array()
                .into_iter()
                .take(channels.count())
        })
        .collect();
    Image::from_f32(size, channels, numbers)
}

/// The mean over the sphere of a latitude-longitude image, each texel by its exact solid angle.
fn lat_long_mean([width, height]: [u32; 2], texel: impl Fn(u32, u32) -> Vec3) -> Vec3 {
    let half_row = core::f32::consts::FRAC_PI_2 / height as f32;
    let mut sum = RgbSum::default();
    for y in 0..height {
        // Half of the difference of the cosines at both edges, without cancellation at the poles.
        let share = sin(half_row * (2 * y + 1) as f32) * sin(half_row);
        (0..width).for_each(|x| sum.add(texel(x, y), f64::from(share)));
    }
    sum.over(f64::from(width))
}
