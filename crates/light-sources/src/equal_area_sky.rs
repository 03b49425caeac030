use alloc::vec::Vec;

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
        let SphereSample { uv, w, pdf } = self.of(coverage).sample(u)?;
        Some(SkySample {
            uv,
            texel: image.nearest(uv),
            wi: transform.vector(w),
            pdf,
        })
    }

    /// The density in sr^-1 of the direction `w`, in light space.
    pub(crate) fn pdf(&self, w: Vec3, coverage: PdfCoverage) -> f32 {
        self.of(coverage).pdf(w)
    }
}

fn means(image: &Image, averages: &Vec<f32>) -> SkyMeans {
    let n = image.size()[0];
    let (mut sum, mut weighted) = (0.0, RgbSum::default());
    for (i, &average) in (0..).zip(averages) {
        let texel = Vec2::new((i % n) as f32, (i / n) as f32) + 0.5;
        sum += f64::from(average);
        weighted.add(square_to_sphere(texel / n as f32), f64::from(average));
    }
    SkyMeans {
        color: image.mean(),
        average: single(sum / averages.len() as f64),
        direction: weighted.over(sum),
    }
}
