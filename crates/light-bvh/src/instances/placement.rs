use core::fmt;

use light_math::glam::{Affine3A, Mat3, Quat, Vec3};

/// How far a rotation may be from one: the error of a few products in single precision.
pub(crate) const RIGID_TOLERANCE: f32 = 1e-5;

/// A prototype turned, scaled alike on all axes, and moved: a point `x` of it is at
/// `translation + scale * (rotation * x)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    pub(crate) prototype: u32,
    pub(crate) rotation: Quat,
    pub(crate) scale: f32,
    pub(crate) translation: Vec3,
    pub(crate) power: f32,
}

impl Placement {
    /// The prototype of index `prototype`, its origin at `translation`.
    #[must_use]
    pub const fn at(prototype: u32, translation: Vec3) -> Self {
        Self {
            prototype,
            rotation: Quat::IDENTITY,
            scale: 1.0,
            translation,
            power: 1.0,
        }
    }

    /// The prototype of index `prototype`, turned by `rotation`, a unit quaternion, scaled by
    /// `scale`, and moved. A negative scale mirrors it: each light then emits from the mirror image
    /// of its side.
    ///
    /// The powers of its lights are multiplied by the square of the scale, as those of surfaces
    /// whose radiance stays are: see [`with_power`](Self::with_power).
    ///
    /// # Errors
    /// The first of the numbers that cannot be one of a transform.
    pub fn new(
        prototype: u32,
        rotation: Quat,
        scale: f32,
        translation: Vec3,
    ) -> Result<Self, PlacementError> {
        if !translation.is_finite() {
            return Err(PlacementError::Translation);
        }
        if !(scale.is_finite() && (1.0 / scale).is_finite() && scale * scale > 0.0) {
            return Err(PlacementError::Scale);
        }
        if !((rotation.length_squared() - 1.0).abs() <= RIGID_TOLERANCE) {
            return Err(PlacementError::Rotation);
        }
        Ok(Self {
            prototype,
            rotation: rotation.normalize(),
            scale,
            translation,
            power: (scale * scale).min(f32::MAX),
        })
    }

    /// The same with the transform of a matrix, which takes points of the prototype to where they
    /// are placed.
    ///
    /// # Errors
    /// [`PlacementError::NotRigid`] if the matrix shears, or scales the axes differently; the
    /// lights of such an object are copied instead. Those of [`new`](Self::new).
    pub fn from_matrix(prototype: u32, to_scene: &Affine3A) -> Result<Self, PlacementError> {
        let linear = Mat3::from(to_scene.matrix3);
        if !linear.is_finite() {
            return Err(PlacementError::Scale);
        }
        // Divided by the largest entry first: squares of any finite matrix stay finite.
        let columns = linear.to_cols_array();
        let largest = columns.iter().fold(0.0f32, |most, x| most.max(x.abs()));
        let unit = linear * (1.0 / largest.max(f32::MIN_POSITIVE));
        let columns = [unit.x_axis, unit.y_axis, unit.z_axis];
        let mean_sq = columns.map(Vec3::length_squared).iter().sum::<f32>() / 3.0;
        let sign = 1.0f32.copysign(unit.determinant());
        let size = sign * light_math::float::sqrt(mean_sq);
        let rotation = unit * (1.0 / size);
        let gram = rotation.transpose() * rotation;
        if !(gram.abs_diff_eq(Mat3::IDENTITY, RIGID_TOLERANCE)) {
            return Err(PlacementError::NotRigid);
        }
        let rotation = Quat::from_mat3(&rotation);
        Self::new(
            prototype,
            rotation,
            size * largest,
            to_scene.translation.into(),
        )
    }

    /// The same placement, with the powers of the prototype's lights multiplied by `power`: 1 for
    /// points, whose intensity does not depend on the scale, 0 where it is dark.
    ///
    /// # Errors
    /// [`PlacementError::Power`] if it is negative or not finite.
    pub fn with_power(self, power: f32) -> Result<Self, PlacementError> {
        if power >= 0.0 && power.is_finite() {
            Ok(Self { power, ..self })
        } else {
            Err(PlacementError::Power)
        }
    }

    /// The index of the prototype.
    #[must_use]
    pub const fn prototype(&self) -> u32 {
        self.prototype
    }
}

/// Why something cannot be the transform of a [`Placement`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlacementError {
    /// The translation is not finite.
    Translation,
    /// The scale is 0 or not finite, or its square or its inverse is.
    Scale,
    /// The rotation is no unit quaternion.
    Rotation,
    /// The transform is not a rotation, one scale for all axes, and a translation.
    NotRigid,
    /// The factor of the powers is negative or not finite.
    Power,
}

impl fmt::Display for PlacementError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Translation => "the translation is not finite",
            Self::Scale => "the scale is 0 or not finite",
            Self::Rotation => "the rotation is not a unit quaternion",
            Self::NotRigid => "the transform shears, or scales its axes differently",
            Self::Power => "the factor of the powers is negative or not finite",
        })
    }
}

impl core::error::Error for PlacementError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_is_taken_apart() {
        let turn = Quat::from_axis_angle(Vec3::new(0.0, 0.6, 0.8), 1.0);
        for scale in [1.0, 1e-15, 3e15, -2.0] {
            let moved = Vec3::new(1.0, -2.0, 3.0);
            let matrix = Affine3A::from_scale_rotation_translation(Vec3::splat(scale), turn, moved);
            let placed = Placement::from_matrix(7, &matrix).expect("rigid");
            assert_eq!(
                (placed.prototype(), placed.translation),
                (7, moved),
                "{scale}"
            );
            assert!((placed.scale / scale - 1.0).abs() < 1e-5, "{placed:?}");
            assert!(placed.rotation.dot(turn).abs() > 1.0 - 1e-6, "{placed:?}");
            assert_eq!(placed.power, placed.scale * placed.scale, "of surfaces");
        }
    }

    #[test]
    fn other_transforms_are_refused_by_name() {
        let scaled = |scale| Affine3A::from_scale(scale);
        let refused = |matrix: Affine3A| Placement::from_matrix(0, &matrix).err();
        let unlike = scaled(Vec3::new(1.0, 1.0, 1.01));
        assert_eq!(refused(unlike), Some(PlacementError::NotRigid), "scales");
        let shear =
            Affine3A::from_mat3(Mat3::from_cols(Vec3::X, Vec3::new(0.1, 1.0, 0.0), Vec3::Z));
        assert_eq!(refused(shear), Some(PlacementError::NotRigid), "a shear");
        for none in [0.0, f32::NAN, f32::INFINITY] {
            let error = refused(scaled(Vec3::splat(none)));
            let by_name = [Some(PlacementError::Scale), Some(PlacementError::NotRigid)];
            assert!(by_name.contains(&error), "{none}: {error:?}");
        }
        let nowhere = Affine3A::from_translation(Vec3::splat(f32::INFINITY));
        assert_eq!(refused(nowhere), Some(PlacementError::Translation), "far");
        let quat = Quat::from_xyzw(0.0, 0.0, 0.0, 1.1);
        let error = Placement::new(0, quat, 1.0, Vec3::ZERO).err();
        assert_eq!(error, Some(PlacementError::Rotation), "not a unit");
        let error = Placement::new(0, Quat::IDENTITY, 1e-30, Vec3::ZERO).err();
        assert_eq!(error, Some(PlacementError::Scale), "its square vanishes");
        for power in [-1.0, f32::NAN, f32::INFINITY] {
            let error = Placement::at(0, Vec3::ZERO).with_power(power).err();
            assert_eq!(error, Some(PlacementError::Power), "{power}");
        }
    }
}
