use crate::environment_table::EnvironmentTable;
use crate::glam::{Vec2, Vec3};
use crate::image::Image;
use crate::mis_compensation::compensate;
use crate::pdf_coverage::PdfCoverage;
use crate::rgb_sum::{RgbSum, single};
use crate::rigid_transform::RigidTransform;
use crate::sky_means::SkyMeans;
use crate::sky_sample::SkySample;
use crate::sphere_table::{SphereSample, SphereTable};
use light_math::equal_area::square_to_sphere;

/// Directions of the sphere in proportion to the texels of an equal-area image.
///
/// Two tables of 8 bytes a texel.
#[derive(Clone, Debug)]
pub(crate) struct EqualAreaSky {
    complete: SphereTable,
    compensated: SphereTable,
}

impl EqualAreaSky {
    /// The directions of a square image, and its means.
    pub(crate) fn new(image: &Image) -> (Self, SkyMeans) {
        let averages = image.averages();
        let n = image.size()[0];
        let sky = Self {
            compensated: SphereTable::new(&compensate(&averages), n),
            complete: SphereTable::new(&averages, n),
        };
        (sky, means(image, &averages))
    }

    pub(crate) fn bytes(&self) -> usize {
        self.complete.bytes() + self.compensated.bytes()
    }

    fn of(&self, coverage: PdfCoverage) -> &SphereTable {
        match coverage {
            PdfCoverage::Complete => &self.complete,
            PdfCoverage::Incomplete => &self.compensated,
        }
    }

    /// The numbers of [`sample`](Self::sample); `None` if the image is black.
    pub(crate) fn table(&self, coverage: PdfCoverage) -> Option<EnvironmentTable> {
        self.of(coverage).table()
    }

    /// A direction in the scene, chosen by `u`; `None` if the image is black.
    pub(crate) fn sample(
        &self,
        image: &Image,
        u: Vec2,
        coverage: PdfCoverage,
        transform: &RigidTransform,
    ) -> Option<SkySample> {
        let table = self.of(coverage);
        let SphereSample {
            uv,
            w: wi,
            pdf,
            texel,
        } = table.sample(u, transform)?;
        let [x, y] = texel;
        Some(SkySample {
            uv,
            texel: image.texel(x, y),
            wi,
            pdf,
        })
    }

    /// The density in sr^-1 of the direction `w`, in light space.
    pub(crate) fn pdf(&self, w: Vec3, coverage: PdfCoverage) -> f32 {
        self.of(coverage).pdf(w)
    }
}

/// Texels along a side up to which a texel is wider than its centre can stand for.
const FEW_TEXELS: u32 = 64;

fn means(image: &Image, averages: &[f32]) -> SkyMeans {
    let n = image.size()[0];
    // Points along each side of a texel: one where texels are small. An even number of points along
    // the image mirrors the upper half of the sphere in the lower one.
    let k = (2 * (FEW_TEXELS / n)).max(1);
    let (mut sum, mut weighted) = (0.0, RgbSum::default());
    for (i, &average) in (0..).zip(averages) {
        let corner = Vec2::new((i % n) as f32, (i / n) as f32);
        sum += f64::from(average);
        for j in 0..k * k {
            let point = (Vec2::new((j % k) as f32, (j / k) as f32) + 0.5) / k as f32;
            let w = square_to_sphere((corner + point) / n as f32);
            weighted.add(w, f64::from(average) / f64::from(k * k));
        }
    }
    SkyMeans {
        color: image.mean(),
        average: single(sum / averages.len() as f64),
        direction: weighted.over(sum),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::channels::Channels;
    use alloc::vec::Vec;

    fn mean_direction(n: u32, texel: impl Fn(u32) -> f32) -> Vec3 {
        let texels: Vec<f32> = (0..n * n).map(texel).collect();
        let image = Image::from_f32([n, n], Channels::Gray, texels).expect("an image");
        EqualAreaSky::new(&image).1.direction
    }

    #[test]
    fn a_constant_sky_has_no_direction() {
        for n in (1..=20).chain([63, 64, 65, 67, 100, 129]) {
            let mean = mean_direction(n, |_| 0.7);
            assert!(mean.length() < 1e-3, "{n} x {n}: {mean}");
        }
    }

    /// A picture is the same sky at four times the texels.
    #[test]
    fn the_direction_is_that_of_the_whole_texel() {
        for n in [1, 2, 3, 6, 7, 16] {
            let few = |i: u32| {
                if i % 3 == 0 {
                    2.0
                } else {
                    f32::from(i == n / 2)
                }
            };
            let fine = 256 / n * n;
            let many = |i: u32| few(i / fine * n / fine * n + i % fine * n / fine);
            let (few, many) = (mean_direction(n, few), mean_direction(fine, many));
            assert!(few.distance(many) < 1e-3, "{n} x {n}: {few}, not {many}");
        }
    }
}
