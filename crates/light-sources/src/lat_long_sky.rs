use alloc::vec::Vec;
use core::f64::consts::FRAC_1_PI;

use crate::environment_table::{EnvironmentTable, INSETS};
use crate::glam::{DVec2, Vec2, Vec3};
use crate::image::Image;
use crate::lat_long_grid::LatLongGrid;
use crate::pdf_coverage::PdfCoverage;
use crate::rgb_sum::{RgbSum, single};
use crate::rigid_transform::RigidTransform;
use crate::sky_means::SkyMeans;
use crate::sky_sample::SkySample;
use crate::texel_sums::{TexelPlace, TexelSums};
use light_math::float::inverse_power_of_two;
use light_math::{SphereMap, lat_long};

/// Directions of the sphere in proportion to the texels of a lat-long image: uniform over the solid
/// angle of the texel that is chosen.
///
/// Two tables of 4 bytes a texel; densities are computed from the image. Queries take `f32` alone,
/// the sums of the build `f64`.
#[derive(Clone, Debug)]
pub(crate) struct LatLongSky {
    grid: LatLongGrid,
    /// `None` when the image is black.
    complete: Option<TexelChoice>,
    /// By what is above the mean; `None` when nothing is, for an image that is the same everywhere.
    compensated: Option<TexelChoice>,
}

/// Texels in proportion to what they have above a threshold.
#[derive(Clone, Debug)]
struct TexelChoice {
    sums: TexelSums,
    threshold: f32,
    /// A power of two near the inverse of the mean weight, by which no weight loses a digit.
    scale: f32,
    /// The density of a weight times `scale`, in sr^-1.
    per_steradian: f32,
}

/// What one pass over a row learns.
#[derive(Clone, Copy, Debug)]
struct RowMoments {
    color: RgbSum,
    weight: f64,
    /// Weights times the directions of columns.
    aside: DVec2,
}

impl LatLongSky {
    /// The directions of `image`, and its means.
    pub(crate) fn new(image: &Image) -> (Self, SkyMeans) {
        let (grid, size) = (LatLongGrid::new(image.size()), image.size());
        let width = f64::from(size[0]);
        let rows = 0..size[1];
        let shares: Vec<f64> = rows.map(|y| grid.row_share(y) / width).collect();
        let columns = grid.columns();
        let (sums, moments) = TexelSums::new(size, &shares, |y, row| {
            let moments = RowMoments::new(image, y, &columns, row);
            (moments.weight, moments)
        });
        let (mut color, mut total) = (RgbSum::default(), 0.0);
        for (moments, share) in moments.iter().zip(&shares) {
            color.add_sum(&moments.color, *share);
            total += moments.weight * share;
        }
        let aside = moments.iter().map(|row| (row.aside, row.weight));
        let direction = grid.direction_sum(aside);
        let means = SkyMeans {
            color: color.over(1.0),
            average: single(total / 3.0),
            direction: if total > 0.0 {
                (direction / total).as_vec3()
            } else {
                Vec3::ZERO
            },
        };

        let threshold = single(total);
        let (above, _) = TexelSums::new(size, &shares, |y, row| {
            let (mut total, mut weights) = (0.0, row.iter_mut());
            image.for_each_in_row(y, |texel| {
                let Some(above) = weights.next() else { return };
                *above = weight(texel, threshold);
                total += f64::from(*above);
            });
            (total, ())
        });
        let choice = |threshold| {
            move |(sums, mean): (TexelSums, f64)| TexelChoice::new(sums, mean, threshold)
        };
        let sky = Self {
            grid,
            complete: sums.map(choice(0.0)),
            compensated: above.map(choice(threshold)),
        };
        (sky, means)
    }

    pub(crate) fn bytes(&self) -> usize {
        let choices = [&self.complete, &self.compensated];
        let bytes = choices.map(|choice| choice.as_ref().map_or(0, |choice| choice.sums.bytes()));
        bytes.iter().sum()
    }

    fn choice(&self, coverage: PdfCoverage) -> Option<&TexelChoice> {
        match coverage {
            PdfCoverage::Complete => self.complete.as_ref(),
            PdfCoverage::Incomplete => self.compensated.as_ref().or(self.complete.as_ref()),
        }
    }

    /// The numbers of [`sample`](Self::sample), for samplers elsewhere; `None` if the image is
    /// black.
    pub(crate) fn table(&self, image: &Image, coverage: PdfCoverage) -> Option<EnvironmentTable> {
        let choice = self.choice(coverage)?;
        let [columns, rows] = choice.sums.shares();
        Some(EnvironmentTable {
            map: SphereMap::LatLong,
            size: image.size(),
            columns: columns.to_vec(),
            rows: rows.to_vec(),
            densities: image.texels().map(|texel| choice.pdf(texel)).collect(),
            caps: self.grid.shares().to_vec(),
        })
    }

    /// A direction in the scene, chosen by `u`; `None` if the image is black.
    ///
    /// The direction is one of the texel that was chosen, after all rounding, so that queries
    /// return for it the values of the sample, unless the texel is smaller than rounding.
    pub(crate) fn sample(
        &self,
        image: &Image,
        u: Vec2,
        coverage: PdfCoverage,
        transform: &RigidTransform,
    ) -> Option<SkySample> {
        let choice = self.choice(coverage)?;
        let TexelPlace { texel, place } = choice.sums.sample(u);
        let look = |inset: f32| {
            let place = 0.5 + (place - 0.5) * inset;
            let wi = transform.vector(self.grid.direction(texel, place));
            (wi, lat_long::uv(transform.inverse_vector(wi)))
        };
        let mut found = look(1.0);
        for inset in INSETS {
            if image.texel_at(found.1) == texel {
                break;
            }
            found = look(inset);
        }
        let [x, y] = texel;
        let color = image.texel(x, y);
        Some(SkySample {
            uv: found.1,
            texel: color,
            wi: found.0,
            pdf: choice.pdf(color),
        })
    }

    /// The density in sr^-1 of the directions of a texel of the given colour.
    pub(crate) fn pdf(&self, texel: Vec3, coverage: PdfCoverage) -> f32 {
        self.choice(coverage)
            .map_or(0.0, |choice| choice.pdf(texel))
    }
}

impl TexelChoice {
    fn new(sums: TexelSums, mean: f64, threshold: f32) -> Self {
        let scale = inverse_power_of_two(single(mean));
        Self {
            sums,
            threshold,
            scale,
            per_steradian: single(0.25 * FRAC_1_PI / (mean * f64::from(scale))),
        }
    }

    fn pdf(&self, texel: Vec3) -> f32 {
        let weight = weight(texel, self.threshold);
        if weight > 0.0 {
            // A texel that is dark beside the others is rare, not impossible.
            (weight * self.scale * self.per_steradian).max(f32::MIN_POSITIVE)
        } else {
            0.0
        }
    }
}

impl RowMoments {
    /// Writes the weights of the texels of row `y` into `weights`, and returns the sums of colours,
    /// of weights and of weighted directions.
    fn new(image: &Image, y: u32, columns: &[DVec2], weights: &mut [f32]) -> Self {
        let mut moments = Self {
            color: RgbSum::default(),
            weight: 0.0,
            aside: DVec2::ZERO,
        };
        let mut weights = weights.iter_mut().zip(columns);
        image.for_each_in_row(y, |texel| {
            let Some((out, column)) = weights.next() else {
                return;
            };
            *out = weight(texel, 0.0);
            let weight = f64::from(*out);
            moments.color.add(texel, 1.0);
            moments.weight += weight;
            moments.aside += *column * weight;
        });
        moments
    }
}

/// What the channels of a texel add up to above a threshold.
#[inline]
fn weight(texel: Vec3, threshold: f32) -> f32 {
    (texel.element_sum() - threshold).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::channels::Channels;
    use core::f64::consts::PI;

    const SIZE: [u32; 2] = [5, 3];

    /// Two thirds of the texels are above the mean or far below it, one is black.
    fn image() -> Image {
        let texels: Vec<f32> = (0..15u8).map(|i| f32::from(i * 7 % 15)).collect();
        Image::from_f32(SIZE, Channels::Gray, texels).expect("an image")
    }

    const COVERAGES: [PdfCoverage; 2] = [PdfCoverage::Complete, PdfCoverage::Incomplete];

    #[test]
    fn densities_integrate_to_one_and_follow_texels() {
        let image = image();
        let (sky, means) = LatLongSky::new(&image);
        let grid = LatLongGrid::new(SIZE);
        for coverage in COVERAGES {
            let threshold = match coverage {
                PdfCoverage::Complete => 0.0,
                PdfCoverage::Incomplete => means.average,
            };
            let (mut sum, mut ratios) = (0.0, Vec::new());
            for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
                let texel = image.texel(x, y);
                let pdf = f64::from(sky.pdf(texel, coverage));
                let above = f64::from((texel.x - threshold).max(0.0));
                assert_eq!(pdf > 0.0, above > 0.0, "{x}, {y}");
                sum += pdf * 4.0 * PI * grid.row_share(y) / f64::from(SIZE[0]);
                ratios.extend((above > 0.0).then_some(pdf / above));
            }
            assert!((sum - 1.0).abs() < 1e-5, "{coverage:?}: {sum}");
            let even = ratios.iter().all(|r| (r / ratios[0] - 1.0).abs() < 1e-5);
            assert!(even, "{coverage:?}: {ratios:?}");
        }
    }

    #[test]
    fn samples_are_even_within_their_texel_and_answer_as_queries() {
        let image = image();
        let (sky, _) = LatLongSky::new(&image);
        let transform = RigidTransform::default();
        for coverage in COVERAGES {
            let (mut places, n) = (Vec2::ZERO, 40u16);
            for i in 0..n * n {
                let u = (Vec2::new(f32::from(i % n), f32::from(i / n)) + 0.5) / f32::from(n);
                let sample = sky.sample(&image, u, coverage, &transform).expect("light");
                let [x, y] = image.texel_at(sample.uv);
                assert_eq!(sample.texel, image.texel(x, y), "{u}");
                assert_eq!(sample.pdf, sky.pdf(sample.texel, coverage), "{u}");
                let extent = Vec2::new(SIZE[0] as f32, SIZE[1] as f32);
                places += sample.uv * extent - Vec2::new(x as f32, y as f32);
            }
            let mean = places / f32::from(n * n);
            // Along a row alone: the rows at the poles are narrower there.
            assert!((mean.x - 0.5).abs() < 0.03, "{coverage:?}: {mean}");
        }
    }
}
