use lights::glam::Vec3;

use super::bsdf_sample::BsdfSample;

/// A plane mirror of constant reflectance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// Reflectance.
    pub reflectance: Vec3,
}

impl Mirror {
    /// The direction that is reflected toward `wo`.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3) -> Option<BsdfSample> {
        (self.reflectance != Vec3::ZERO).then_some(BsdfSample {
            wi: Vec3::new(-wo.x, -wo.y, wo.z),
            weight: self.reflectance,
            pdf: None,
            eta: 1.0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angle_of_incidence_is_the_angle_of_reflection() {
        let mirror = Mirror {
            reflectance: Vec3::splat(0.9),
        };
        let s = mirror
            .sample(Vec3::new(0.6, 0.0, -0.8))
            .expect("a direction");
        assert_eq!(s.wi, Vec3::new(-0.6, 0.0, -0.8), "mirrored, on both sides");
        assert_eq!((s.weight, s.pdf), (Vec3::splat(0.9), None), "a Dirac");
        let black = Mirror {
            reflectance: Vec3::ZERO,
        };
        assert_eq!(black.sample(Vec3::Z), None, "nothing to reflect");
    }
}
