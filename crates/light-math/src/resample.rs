use core::ops::{Add, Mul};

use glam::Vec2;

use crate::float::ceil;
use crate::sphere_image::{SphereImage, SphereImageError, SphereMap, check, extent};

/// Turns an image of the sphere into one of another size or map: lat-long to equal-area, as
/// environment maps need it, and back.
///
/// A texel becomes the mean, over its solid angle, of the source interpolated bilinearly: by a
/// lattice of directions, of which at least eight fall into each texel of the
/// result and into each of the source (at the equator, where they are largest). Constant images
/// stay constant. The energy of a smooth image is kept within 1e-3; that of a sun of a single texel
/// within 3 % in the mean and 10 % at worst over the places where it may be, the slivers next to
/// the poles of a lat-long source apart. A texel costs about a microsecond.
///
/// Each texel is a function of the source alone, so callers may take them [in order](Self::texels)
/// into a buffer of theirs, or [one by one](Self::texel) on many threads.
#[derive(Clone, Copy, Debug)]
pub struct Resampler<F> {
    source: SphereImage<F>,
    map: SphereMap,
    size: [u32; 2],
    /// Directions in each texel.
    samples: u32,
}

impl<F> Resampler<F> {
    /// How many directions fall at least into a source texel, and into a texel of the result.
    const DENSITY: u32 = 8;

    /// The resampler of `source` to an image of the given map and size.
    ///
    /// # Errors
    /// If the size is zero, or not square for an equal-area image.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive, and saturates"
    )]
    pub fn new(
        source: SphereImage<F>,
        map: SphereMap,
        size: [u32; 2],
    ) -> Result<Self, SphereImageError> {
        check(map, size)?;
        let largest_texel = |map: SphereMap, size: [u32; 2]| {
            map.solid_angle_per_area(Vec2::splat(0.5)) / extent(size).element_product()
        };
        let ratio = largest_texel(map, size) / largest_texel(source.map(), source.size());
        Ok(Self {
            source,
            map,
            size,
            samples: ceil(Self::DENSITY as f32 * ratio.max(1.0)) as u32,
        })
    }

    /// The texel at column `x` and row `y` of the result.
    #[must_use]
    pub fn texel<T>(&self, x: u32, y: u32) -> T
    where
        F: Fn(u32, u32) -> T,
        T: Add<Output = T> + Mul<f32, Output = T>,
    {
        let corner = Vec2::new(x as f32, y as f32);
        let size = extent(self.size);
        let sample = |i: u32| {
            let p = (corner + lattice_point(i, self.samples)) / size;
            let weight = self.map.solid_angle_per_area(p);
            (self.source.bilinear(self.map.direction(p)) * weight, weight)
        };
        let (mut sum, mut weights) = sample(0);
        for i in 1..self.samples {
            let (value, weight) = sample(i);
            sum = sum + value;
            weights += weight;
        }
        sum * (1.0 / weights)
    }

    /// All texels, row by row from the top left.
    pub fn texels<T>(&self) -> impl Iterator<Item = T>
    where
        F: Fn(u32, u32) -> T,
        T: Add<Output = T> + Mul<f32, Output = T>,
    {
        (0..self.size[1]).flat_map(move |y| (0..self.size[0]).map(move |x| self.texel(x, y)))
    }
}

/// Point `i` of `n` well spread ones in the unit square.
#[inline]
fn lattice_point(i: u32, n: u32) -> Vec2 {
    // Multiples of the golden ratio, as a fraction of 2^32.
    let x = i.wrapping_mul(0x9E37_79B9) as f32 * (1.0 / 4_294_967_296.0);
    Vec2::new(x, (i as f32 + 0.5) / n as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use core::f32::consts::PI;
    use glam::Vec3;

    const LAT_LONG: (SphereMap, [u32; 2]) = (SphereMap::LatLong, [64, 32]);
    const EQUAL_AREA: (SphereMap, [u32; 2]) = (SphereMap::EqualArea, [40, 40]);

    /// The image of a function of direction, by the values at the centres of texels.
    fn render((map, size): (SphereMap, [u32; 2]), f: impl Fn(Vec3) -> f32) -> Vec<f32> {
        let center = |x: u32, y: u32| Vec2::new(x as f32 + 0.5, y as f32 + 0.5) / extent(size);
        (0..size[1])
            .flat_map(|y| (0..size[0]).map(move |x| (x, y)))
            .map(|(x, y)| f(map.direction(center(x, y))))
            .collect()
    }

    /// The integral over the sphere.
    fn energy((map, size): (SphereMap, [u32; 2]), texels: &[f32]) -> f32 {
        let rows = texels.chunks_exact(size[0] as usize).enumerate();
        rows.map(|(y, row)| {
            let texel = match map {
                SphereMap::EqualArea => 4.0 * PI / extent(size).element_product(),
                SphereMap::LatLong => {
                    let edge = |y: usize| (PI * y as f32 / size[1] as f32).cos();
                    2.0 * PI / size[0] as f32 * (edge(y) - edge(y + 1))
                }
            };
            row.iter().sum::<f32>() * texel
        })
        .sum()
    }

    fn convert(from: (SphereMap, [u32; 2]), texels: &[f32], to: (SphereMap, [u32; 2])) -> Vec<f32> {
        let texel = |x, y| texels[(y * from.1[0] + x) as usize];
        let source = SphereImage::new(from.0, from.1, texel).expect("valid");
        let resampler = Resampler::new(source, to.0, to.1).expect("valid");
        resampler.texels().collect()
    }

    /// Something smooth without symmetry.
    fn sky(d: Vec3) -> f32 {
        2.0 + d.y + (3.0 * d.x).sin() * d.z + d.x * d.y
    }

    #[test]
    fn constant_images_stay_constant() {
        for (from, to) in [(LAT_LONG, EQUAL_AREA), (EQUAL_AREA, LAT_LONG)] {
            let out = convert(from, &render(from, |_| 3.0), to);
            assert!(out.iter().all(|v| (v - 3.0).abs() < 1e-5), "{from:?}");
        }
    }

    #[test]
    fn smooth_images_keep_values_and_energy() {
        let smaller = (SphereMap::EqualArea, [16, 16]);
        let larger = (SphereMap::LatLong, [100, 50]);
        for (from, to) in [
            (LAT_LONG, EQUAL_AREA),
            (EQUAL_AREA, LAT_LONG),
            (LAT_LONG, smaller),
            (EQUAL_AREA, larger),
        ] {
            let source = render(from, sky);
            let out = convert(from, &source, to);
            let ratio = energy(to, &out) / energy(from, &source);
            assert!((ratio - 1.0).abs() < 1e-3, "{from:?} to {to:?}: {ratio}");
            let exact = render(to, sky);
            let worst = out.iter().zip(&exact).map(|(a, b)| (a - b).abs());
            let worst = worst.fold(0.0, f32::max);
            // A mean over a large texel is not the value at its centre.
            assert!(worst < 0.1, "{from:?} to {to:?}: {worst}");
        }
    }

    #[test]
    fn a_sun_of_one_texel_keeps_its_energy() {
        for (from, to) in [(LAT_LONG, EQUAL_AREA), (EQUAL_AREA, LAT_LONG)] {
            let (mut worst, mut sum, mut count) = (0.0f32, 0.0, 0.0);
            for i in (0..from.1[0] * from.1[1]).step_by(97) {
                let y = i / from.1[0];
                let near_pole = from.0 == SphereMap::LatLong && !(6..26).contains(&y);
                if near_pole {
                    continue;
                }
                let mut source = render(from, |_| 0.0);
                source[i as usize] = 1000.0;
                let ratio = energy(to, &convert(from, &source, to)) / energy(from, &source);
                worst = worst.max((ratio - 1.0).abs());
                sum += (ratio - 1.0).abs();
                count += 1.0;
            }
            assert!(
                worst < 0.1 && sum / count < 0.03,
                "{from:?}: {worst} {}",
                sum / count
            );
        }
    }

    #[test]
    fn refuses_sizes_that_the_map_does_not_have() {
        use SphereImageError::{Empty, NotSquare};
        let image = SphereImage::new(SphereMap::LatLong, [2, 1], |_, _| 0.0f32).expect("valid");
        let new = |map, size| Resampler::new(image, map, size).err();
        assert_eq!(new(SphereMap::LatLong, [3, 0]), Some(Empty), "rows");
        assert_eq!(new(SphereMap::EqualArea, [3, 2]), Some(NotSquare), "square");
    }
}
