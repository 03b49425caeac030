use core::error::Error;
use core::fmt;

use crate::glam::{Affine3A, Mat3, Vec3};
use light_math::float::sqrt;

/// A transform that keeps lengths: a rotation or a reflection, then a translation. It takes light
/// space to scene space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidTransform {
    linear: Mat3,
    translation: Vec3,
}

/// Why a transform is not rigid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RigidTransformError {
    /// An entry is NaN or infinite.
    NotFinite,
    /// The transform scales, shears or flattens: some axis is not of unit length or not
    /// perpendicular to another.
    NotRigid,
}

/// Tolerance of the products of axes: files write six digits.
const TOLERANCE: f32 = 1e-4;

impl RigidTransform {
    /// The identity.
    pub const IDENTITY: Self = Self {
        linear: Mat3::IDENTITY,
        translation: Vec3::ZERO,
    };

    /// The rigid transform next to `transform`, whose axes may be off by rounding error, 1e-4, and
    /// are then made exact.
    ///
    /// # Errors
    /// When an entry is not finite, or the linear part scales, shears or flattens.
    pub fn new(transform: Affine3A) -> Result<Self, RigidTransformError> {
        if !transform.is_finite() {
            return Err(RigidTransformError::NotFinite);
        }
        let m = Mat3::from(transform.matrix3);
        let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
        let off = |value: f32, exact: f32| !((value - exact).abs() <= TOLERANCE);
        let scales = off(x.dot(x), 1.0) || off(y.dot(y), 1.0) || off(z.dot(z), 1.0);
        let shears = off(x.dot(y), 0.0) || off(y.dot(z), 0.0) || off(z.dot(x), 0.0);
        if scales || shears {
            return Err(RigidTransformError::NotRigid);
        }
        // The axis z is kept: it is the axis of most lights.
        let z = z.normalize();
        let x = (x - z * z.dot(x)).normalize();
        let y = z.cross(x) * z.cross(x).dot(y).signum();
        Ok(Self {
            linear: Mat3::from_cols(x, y, z),
            translation: transform.translation.into(),
        })
    }

    /// The origin of light space in the scene.
    #[must_use]
    pub const fn origin(&self) -> Vec3 {
        self.translation
    }

    /// The light's axis +z in the scene, a unit vector.
    #[must_use]
    pub const fn axis(&self) -> Vec3 {
        self.linear.z_axis
    }

    /// Takes a point from light space to scene space.
    #[inline]
    #[must_use]
    pub fn point(&self, p: Vec3) -> Vec3 {
        self.linear * p + self.translation
    }

    /// Takes a vector from light space to scene space.
    #[inline]
    #[must_use]
    pub fn vector(&self, v: Vec3) -> Vec3 {
        self.linear * v
    }

    /// How far a circle of radius 1 about the light's axis reaches along each axis of the scene,
    /// rounded up.
    #[must_use]
    pub(crate) fn circle_reach(&self) -> Vec3 {
        let Mat3 { x_axis, y_axis, .. } = self.linear;
        // The axis itself does not tell: next to 1 its components have lost what is left for the
        // circle.
        let reach = (x_axis * x_axis + y_axis * y_axis).map(sqrt);
        reach * (1.0 + 4.0 * f32::EPSILON)
    }

    /// Takes a point from scene space to light space.
    #[inline]
    #[must_use]
    pub(crate) fn inverse_point(&self, p: Vec3) -> Vec3 {
        self.inverse_vector(p - self.translation)
    }

    /// Takes a vector from scene space to light space.
    #[inline]
    #[must_use]
    pub(crate) fn inverse_vector(&self, v: Vec3) -> Vec3 {
        let m = &self.linear;
        Vec3::new(m.x_axis.dot(v), m.y_axis.dot(v), m.z_axis.dot(v))
    }
}

impl Default for RigidTransform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl From<RigidTransform> for Affine3A {
    fn from(rigid: RigidTransform) -> Self {
        Self::from_mat3_translation(rigid.linear, rigid.translation)
    }
}

impl fmt::Display for RigidTransformError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "transform: every entry must be finite",
            Self::NotRigid => "transform: must be rigid, without scale or shear",
        })
    }
}

impl Error for RigidTransformError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glam::Quat;

    #[test]
    fn refuses_scale_shear_and_nonsense() {
        let scale = Affine3A::from_scale(Vec3::new(1.0, 1.0, 1.001));
        assert_eq!(
            RigidTransform::new(scale),
            Err(RigidTransformError::NotRigid),
            "scale"
        );
        let mut shear = Affine3A::IDENTITY;
        shear.matrix3.x_axis.y = 0.01;
        assert_eq!(
            RigidTransform::new(shear),
            Err(RigidTransformError::NotRigid),
            "shear"
        );
        let flat = Affine3A::from_scale(Vec3::new(1.0, 1.0, 0.0));
        assert_eq!(
            RigidTransform::new(flat),
            Err(RigidTransformError::NotRigid),
            "singular"
        );
        let nan = Affine3A::from_translation(Vec3::NAN);
        assert_eq!(
            RigidTransform::new(nan),
            Err(RigidTransformError::NotFinite),
            "NaN"
        );
    }

    #[test]
    fn round_off_is_made_exact_and_reflections_stay() {
        let rotation = Quat::from_rotation_y(0.7) * Quat::from_rotation_x(-1.3);
        for mirror in [Vec3::ONE, Vec3::new(1.0, -1.0, 1.0)] {
            let exact = Affine3A::from_scale_rotation_translation(mirror, rotation, Vec3::ONE);
            let mut rough = exact;
            rough.matrix3.x_axis *= 1.00003;
            let t = RigidTransform::new(rough);
            let Ok(t) = t else {
                unreachable!("within the tolerance")
            };
            assert_eq!(
                (t.origin(), t.axis()),
                (Vec3::ONE, t.vector(Vec3::Z)),
                "light space"
            );
            let v = Vec3::new(0.3, -2.0, 0.9);
            assert!(
                t.vector(v).distance(exact.transform_vector3(v)) < 1e-4,
                "near the input"
            );
            assert!(
                (t.vector(v).length() - v.length()).abs() < 1e-6,
                "keeps lengths"
            );
            assert!(t.inverse_point(t.point(v)).distance(v) < 1e-6, "round trip");
        }
    }
}
