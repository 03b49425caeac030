use light_math::float;
use light_math::glam::Vec3;

/// An angle of deflection, by its cosine and its sine: near straight on and straight back, only
/// the sine has digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deflection {
    /// The cosine: 1 is straight on, -1 straight back.
    pub cos_theta: f32,
    /// The sine, at least 0.
    pub sin_theta: f32,
}

impl Deflection {
    /// The angle of this cosine.
    #[inline]
    #[must_use]
    pub fn from_cos(cos_theta: f32) -> Self {
        Self {
            cos_theta,
            sin_theta: float::safe_sqrt(1.0 - cos_theta * cos_theta),
        }
    }

    /// The deflection at an event from which the unit directions `wo` and `wi` both point away.
    #[inline]
    #[must_use]
    pub fn between(wo: Vec3, wi: Vec3) -> Self {
        let cos_theta = -wo.dot(wi);
        // The sum or difference of near directions is exact, and its part along `wo` has no cross
        // product.
        let across = wi + wo * cos_theta.signum();
        Self {
            cos_theta,
            sin_theta: wo.cross(across).length(),
        }
    }

    /// The angle whose cosine is less by `from_peak` than that of the peak: straight on where
    /// `sign` is 1, straight back where it is -1.
    #[inline]
    pub(super) fn at_distance_from_peak(from_peak: f32, sign: f32) -> Self {
        Self {
            cos_theta: (1.0 - from_peak) * sign,
            sin_theta: float::sqrt(from_peak * (2.0 - from_peak)),
        }
    }

    /// By how much the cosine is less than that of the peak, with all digits near it.
    #[inline]
    pub(super) fn distance_from_peak(self, sign: f32) -> f32 {
        let along = self.cos_theta * sign;
        if along > 0.0 {
            self.sin_theta * self.sin_theta / (1.0 + along)
        } else {
            1.0 - along
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn narrow_angles_have_all_digits() {
        let wo = Vec3::new(0.48, -0.6, 0.64);
        let beside = wo.any_orthonormal_vector();
        for sin in [1e-6, 1e-4, 0.01] {
            for sign in [1.0, -1.0] {
                let wi = wo * sign + beside * sin;
                let exact = wo.as_dvec3().cross(wi.as_dvec3()).length();
                let found = Deflection::between(wo, wi);
                let error = (f64::from(found.sin_theta) / exact - 1.0).abs();
                assert!(error < 1e-6, "{sin}: {found:?} for {exact}");
                assert!((found.cos_theta + sign).abs() < 1e-3, "{found:?}");
            }
        }
        let across = Deflection::between(wo, beside);
        assert!((across.sin_theta - 1.0).abs() < 1e-6, "{across:?}");
        assert_eq!(Deflection::from_cos(0.6).sin_theta, 0.8, "3, 4, 5");
    }
}
