//! Environment maps from one square to the other: the latitude-longitude map that users own, the equal-area map that
//! lights sample.

use alloc::vec::Vec;

use crate::glam::{Vec2, Vec3};
use crate::image::{Channels, Image, ImageError};
use crate::rgb_sum::RgbSum;
use light_math::float::sin;
use light_math::{equal_area, lat_long};

/// Samples of a texel along each axis.
const SAMPLES: u32 = 4;

/// The equal-area image of `n` x `n` texels, at least 1, that a latitude-longitude image becomes.
///
/// Texels are means over 4 x 4 samples. Then each channel is scaled so that the light of the whole sphere stays what it
/// was: small suns would gain or lose otherwise.
///
/// # Errors
/// When `n` is 0.
pub fn lat_long_to_equal_area(image: &Image, n: u32) -> Result<Image, ImageError> {
    let look_up = |uv| image.nearest(lat_long::uv(equal_area::square_to_sphere(uv)));
    let (texels, mean) = supersample([n, n], look_up, |_| 1.0);
    finish([n, n], image.channels(), texels, mean, lat_long_mean(image))
}

/// The latitude-longitude image of the given size that an equal-area image becomes, in the same way.
///
/// # Errors
/// When the size is 0.
pub fn equal_area_to_lat_long(image: &Image, size: [u32; 2]) -> Result<Image, ImageError> {
    let look_up = |uv| image.nearest(equal_area::sphere_to_square(lat_long::direction(uv)));
    let (texels, mean) = supersample(size, look_up, lat_long::solid_angle_per_area);
    finish(size, image.channels(), texels, mean, image.mean())
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

/// The texels of an image of the given size, each the mean of samples of `look_up`, and the mean over all of them by
/// `weight`, a function of v.
fn supersample(
    size: [u32; 2],
    look_up: impl Fn(Vec2) -> Vec3,
    weight: impl Fn(f32) -> f32,
) -> (Vec<Vec3>, Vec3) {
    let mut texels = Vec::new();
    let [width, height] = size;
    let scale = 1.0 / Vec2::new(width as f32, height as f32);
    let (mut sum, mut total) = (RgbSum::default(), 0.0);
    let step = 1.0 / SAMPLES as f32;
    for y in 0..height {
        let row_weight = f64::from(weight((y as f32 + 0.5) * scale.y));
        for x in 0..width {
            let mut texel = Vec3::ZERO;
            for i in 0..SAMPLES * SAMPLES {
                let offset = Vec2::new((i % SAMPLES) as f32, (i / SAMPLES) as f32) + 0.5;
                let uv = (Vec2::new(x as f32, y as f32) + offset * step) * scale;
                texel += look_up(uv) * (step * step);
            }
            texels.push(texel);
            sum.add(texel, row_weight);
            total += row_weight;
        }
    }
    (texels, sum.over(total))
}

/// The image of `texels`, whose mean over the sphere becomes `wanted`.
fn finish(
    size: [u32; 2],
    channels: Channels,
    texels: Vec<Vec3>,
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
fn lat_long_mean(image: &Image) -> Vec3 {
    let [width, height] = image.size();
    let half_row = core::f32::consts::FRAC_PI_2 / height as f32;
    let mut sum = RgbSum::default();
    for y in 0..height {
        // Half of the difference of the cosines at both edges, without cancellation at the poles.
        let share = sin(half_row * (2 * y + 1) as f32) * sin(half_row);
        (0..width).for_each(|x| sum.add(image.texel(x, y), f64::from(share)));
    }
    sum.over(f64::from(width))
}
