use crate::glam::Vec3;
use light_math::{Aabb, DirectionCone};

use crate::LightBoundsError;

/// Subtracted from the cosine of a joined cone: twice the rounding error of joining two cones,
/// which could otherwise make a parent a little narrower than its children.
const JOIN_ERROR: f32 = 4.0 * f32::EPSILON;

/// Allowed deviation of the squared length of an axis from 1: the error of a few rotations in
/// single precision.
pub(crate) const AXIS_TOLERANCE: f32 = 1e-5;

/// Bounds of the position, the directions of emission and the power of a light or a group of
/// lights.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LightBounds {
    /// Box around all emitting points.
    pub bounds: Aabb,
    /// Unit axis of the cone that holds the emitters' normals.
    pub w: Vec3,
    /// Emitted power in W, or in another unit common to all lights; for spot lights as if they
    /// emitted in all directions.
    pub phi: f32,
    /// Cosine of the half angle of the cone of normals.
    pub cos_theta_o: f32,
    /// Cosine of the angle beyond that cone up to which light is emitted.
    pub cos_theta_e: f32,
    /// Whether light is emitted on both sides.
    pub two_sided: bool,
}

impl LightBounds {
    /// The bounds of no light, neutral under [`union`](Self::union).
    pub const EMPTY: Self = Self {
        bounds: Aabb::EMPTY,
        w: Vec3::Z,
        phi: 0.0,
        cos_theta_o: 1.0,
        cos_theta_e: 1.0,
        two_sided: false,
    };

    /// Checks the bounds.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn validate(&self) -> Result<(), LightBoundsError> {
        if self.bounds.is_empty() || !self.bounds.is_finite() {
            return Err(LightBoundsError::Box);
        }
        if !((self.w.length_squared() - 1.0).abs() <= AXIS_TOLERANCE) {
            return Err(LightBoundsError::Axis);
        }
        if !(self.phi >= 0.0 && self.phi.is_finite()) {
            return Err(LightBoundsError::Power);
        }
        let cosines = -1.0..=1.0;
        if !(cosines.contains(&self.cos_theta_o) && cosines.contains(&self.cos_theta_e)) {
            return Err(LightBoundsError::Cosine);
        }
        Ok(())
    }

    /// The centre of the box.
    #[inline]
    #[must_use]
    pub fn centroid(&self) -> Vec3 {
        self.bounds.center()
    }

    /// The cone that holds the emitters' normals.
    #[inline]
    #[must_use]
    pub const fn cone(&self) -> DirectionCone {
        DirectionCone::new(self.w, self.cos_theta_o)
    }

    /// Bounds of both groups of lights together; a group without power is ignored.
    ///
    /// The powers add, up to the largest float.
    ///
    /// # Source
    /// `[PBRT4]`, section 12.6.3. A joined cone is widened by the rounding error of
    /// joining.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        if self.phi == 0.0 {
            return *other;
        }
        if other.phi == 0.0 {
            return *self;
        }
        let cone = self.cone().union(other.cone());
        let cos_theta_o = if self.w == other.w {
            cone.cos_theta
        } else {
            (cone.cos_theta - JOIN_ERROR).max(-1.0)
        };
        Self {
            bounds: self.bounds.union(other.bounds),
            w: cone.w,
            phi: (self.phi + other.phi).min(f32::MAX),
            cos_theta_o,
            cos_theta_e: self.cos_theta_e.min(other.cos_theta_e),
            two_sided: self.two_sided || other.two_sided,
        }
    }
}

impl Default for LightBounds {
    fn default() -> Self {
        Self::EMPTY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lamp(at: Vec3, w: Vec3, phi: f32) -> LightBounds {
        LightBounds {
            bounds: Aabb::from_point(at),
            w,
            phi,
            cos_theta_o: 1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        }
    }

    #[test]
    fn union_adds_power_and_joins_the_rest() {
        let a = lamp(Vec3::ZERO, Vec3::X, 1.0);
        let b = LightBounds {
            two_sided: true,
            cos_theta_e: -0.5,
            ..lamp(Vec3::ONE, Vec3::Y, 2.0)
        };
        let u = a.union(&b);
        assert_eq!(u.phi, 3.0, "powers add");
        assert_eq!(
            u.union(&LightBounds::default()),
            u,
            "the default is no light"
        );
        assert_eq!(u.bounds, Aabb::new(Vec3::ZERO, Vec3::ONE), "boxes join");
        assert_eq!(u.centroid(), Vec3::splat(0.5), "the middle of both");
        assert_eq!(u.cos_theta_e, -0.5, "the wider emission");
        assert!(u.two_sided, "one of them is");
        assert!(
            u.cone().contains(Vec3::X) && u.cone().contains(Vec3::Y),
            "cones join"
        );
        // Two axes at a right angle: normals up to half of it.
        let half = core::f32::consts::FRAC_1_SQRT_2;
        assert!((u.cos_theta_o - half).abs() < 1e-5, "{u:?} is no wider");
    }

    #[test]
    fn union_ignores_groups_without_power() {
        let a = lamp(Vec3::ZERO, Vec3::X, 1.0);
        let dark = lamp(Vec3::ONE, Vec3::Y, 0.0);
        assert_eq!(a.union(&dark), a, "dark on the right");
        assert_eq!(dark.union(&a), a, "dark on the left");
        assert_eq!(a.union(&LightBounds::EMPTY), a, "neutral");
    }

    #[test]
    fn nearly_parallel_axes_widen_the_cone() {
        let tilted = Vec3::new(1e-4, 0.0, 1.0).normalize();
        let u = lamp(Vec3::ZERO, Vec3::Z, 1.0).union(&lamp(Vec3::ZERO, tilted, 1.0));
        assert!(u.cos_theta_o < 1.0, "not a single direction");
    }

    #[test]
    fn powers_stay_finite() {
        let a = lamp(Vec3::ZERO, Vec3::X, f32::MAX);
        assert_eq!(a.union(&a).phi, f32::MAX, "saturated");
    }

    #[test]
    fn each_rule_has_its_error() {
        let good = lamp(Vec3::ZERO, Vec3::X, 1.0);
        assert_eq!(good.validate(), Ok(()), "a lamp");
        let cases = [
            (
                LightBounds {
                    bounds: Aabb::EMPTY,
                    ..good
                },
                LightBoundsError::Box,
            ),
            (
                lamp(Vec3::splat(f32::INFINITY), Vec3::X, 1.0),
                LightBoundsError::Box,
            ),
            (
                lamp(Vec3::ZERO, Vec3::splat(2.0), 1.0),
                LightBoundsError::Axis,
            ),
            (lamp(Vec3::ZERO, Vec3::NAN, 1.0), LightBoundsError::Axis),
            (lamp(Vec3::ZERO, Vec3::X, -1.0), LightBoundsError::Power),
            (lamp(Vec3::ZERO, Vec3::X, f32::NAN), LightBoundsError::Power),
            (
                LightBounds {
                    cos_theta_o: f32::NAN,
                    ..good
                },
                LightBoundsError::Cosine,
            ),
            (
                LightBounds {
                    cos_theta_e: 1.5,
                    ..good
                },
                LightBoundsError::Cosine,
            ),
        ];
        for (bounds, error) in cases {
            assert_eq!(bounds.validate(), Err(error), "{bounds:?}");
        }
    }
}
