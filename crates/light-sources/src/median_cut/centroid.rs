use crate::glam::Vec3;
use crate::rgb_sum::RgbSum;

/// The direction of a light in its region.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Centroid {
    /// At the mean of the region's directions, weighted by luminance.
    #[default]
    Luminance,
    /// At their mean weighted by squared luminance: closer to the bright spot.
    SquaredLuminance,
}

/// The summed light of a region, and the weighted sum of its directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct RegionSum {
    centroid: Centroid,
    irradiance: RgbSum,
    direction: RgbSum,
    weight: f64,
}

/// Means shorter than this have no direction: the region surrounds the sphere evenly.
const SHORTEST_MEAN: f32 = 1e-3;

impl RegionSum {
    pub(super) fn new(centroid: Centroid) -> Self {
        Self {
            centroid,
            irradiance: RgbSum::default(),
            direction: RgbSum::default(),
            weight: 0.0,
        }
    }

    /// Adds a texel of the given radiance and solid angle; its direction is only computed if it
    /// is not black.
    pub(super) fn add(
        &mut self,
        radiance: Vec3,
        solid_angle: f32,
        direction: impl FnOnce() -> Vec3,
    ) {
        if radiance == Vec3::ZERO {
            return;
        }
        let solid_angle = f64::from(solid_angle);
        self.irradiance.add(radiance, solid_angle);
        let luminance = f64::from(luminance(radiance));
        let weight = match self.centroid {
            Centroid::Luminance => luminance * solid_angle,
            Centroid::SquaredLuminance => luminance * luminance * solid_angle,
        };
        self.direction.add(direction(), weight);
        self.weight += weight;
    }

    /// The summed light, in W m^-2.
    pub(super) fn irradiance(&self) -> Vec3 {
        self.irradiance.over(1.0)
    }

    /// The unit vector along the mean direction, if there is one.
    pub(super) fn direction(&self) -> Option<Vec3> {
        let mean = self.direction.over(self.weight);
        (mean.length() > SHORTEST_MEAN).then(|| mean.normalize())
    }
}

/// The luminance of linear RGB that is the energy of a texel.
///
/// # Source
/// `[Debevec2005]`, section 2.
pub(super) fn luminance(rgb: Vec3) -> f32 {
    rgb.dot(Vec3::new(0.2125, 0.7154, 0.0721))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_stand_closer_to_the_bright_spot() {
        let direction = |centroid| {
            let mut sum = RegionSum::new(centroid);
            sum.add(Vec3::splat(3.0), 0.1, || Vec3::X);
            sum.add(Vec3::splat(1.0), 0.1, || Vec3::Y);
            assert!(
                (sum.irradiance() - 0.4).abs().max_element() < 1e-6,
                "(3 + 1) * 0.1"
            );
            sum.direction().expect("one")
        };
        let expected = |x, y| Vec3::new(x, y, 0.0).normalize();
        let near = |a: Vec3, b: Vec3| a.distance(b) < 1e-6;
        assert!(
            near(direction(Centroid::Luminance), expected(3.0, 1.0)),
            "3 to 1"
        );
        assert!(
            near(direction(Centroid::SquaredLuminance), expected(9.0, 1.0)),
            "9 to 1"
        );
    }

    #[test]
    fn opposite_light_has_no_direction() {
        let mut sum = RegionSum::new(Centroid::Luminance);
        assert_eq!(sum.direction(), None, "dark");
        sum.add(Vec3::ONE, 1.0, || Vec3::X);
        sum.add(Vec3::ONE, 1.0, || Vec3::NEG_X);
        assert_eq!(sum.direction(), None, "balanced");
    }
}
