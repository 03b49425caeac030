use crate::glam::{Vec2, Vec3};
use crate::image::Image;
use crate::mis_compensation::compensate;
use crate::rgb_sum::{RgbSum, single};
use crate::sphere_table::SphereTable;
use light_math::equal_area::square_to_sphere;

/// What depends on the equal-area picture of a sky alone, not on how it is turned or scaled.
#[derive(Debug)]
pub(crate) struct ImageSky {
    pub(crate) image: Image,
    /// The mean colour.
    pub(crate) mean: Vec3,
    /// The mean over the channels, too.
    pub(crate) average: f32,
    /// The mean direction toward the light, in light space; the shorter, the wider it is spread.
    pub(crate) mean_direction: Vec3,
    pub(crate) distribution: SphereTable,
    pub(crate) compensated: SphereTable,
}

impl ImageSky {
    pub(crate) fn new(image: Image) -> Self {
        let averages = image.averages();
        let n = image.size()[0];
        let (mut sum, mut weighted) = (0.0, RgbSum::default());
        for (i, &average) in (0..).zip(&averages) {
            let texel = Vec2::new((i % n) as f32, (i / n) as f32) + 0.5;
            sum += f64::from(average);
            weighted.add(square_to_sphere(texel / n as f32), f64::from(average));
        }
        Self {
            mean: image.mean(),
            average: single(sum / averages.len() as f64),
            mean_direction: weighted.over(sum),
            compensated: SphereTable::new(&compensate(&averages), n),
            distribution: SphereTable::new(&averages, n),
            image,
        }
    }

    pub(crate) fn table_bytes(&self) -> usize {
        self.distribution.bytes() + self.compensated.bytes()
    }
}
