use crate::ray::{Ray, Span};
use light_math::Aabb;
use light_math::float::inverse_power_of_two;
use light_math::glam::{Affine3A, Mat3A, Quat, Vec3, Vec3A};

/// The region of a medium: a box in its own space, or unbounded, where the scene encloses it by
/// shapes or not at all.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Region {
    from_scene: Affine3A,
    bounds: Option<Aabb>,
}

/// Why a region is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RegionError {
    /// The box is empty or not finite.
    Bounds,
    /// The transform has an entry that is not finite, or no inverse.
    Transform,
}

impl Default for Region {
    /// The unbounded region.
    fn default() -> Self {
        Self::UNBOUNDED
    }
}

impl Region {
    /// The unbounded region.
    pub const UNBOUNDED: Self = Self {
        from_scene: Affine3A::IDENTITY,
        bounds: None,
    };

    /// The box `bounds` of a space that `to_scene` takes to the scene. The transform must be
    /// invertible.
    ///
    /// # Errors
    /// The box is empty or not finite, or the transform is not finite or has no inverse.
    pub fn new(bounds: Aabb, to_scene: Affine3A) -> Result<Self, RegionError> {
        if bounds.is_empty() || !bounds.is_finite() {
            return Err(RegionError::Bounds);
        }
        let from_scene = inverse(&to_scene).ok_or(RegionError::Transform)?;
        Ok(Self {
            from_scene,
            bounds: Some(bounds),
        })
    }

    /// The box `bounds` of a space that `to_scene` takes to the scene, with the unit cube as its
    /// own space, so that grid lookups need no other transform.
    ///
    /// # Errors
    /// The box is empty, flat or not finite, or the transform is not finite or has no inverse.
    pub fn unit_cube(bounds: Aabb, to_scene: Affine3A) -> Result<Self, RegionError> {
        Self::new(bounds, to_scene)?;
        let from_cube = Affine3A::from_scale_rotation_translation(
            bounds.diagonal(),
            Quat::IDENTITY,
            bounds.min,
        );
        Self::new(Aabb::new(Vec3::ZERO, Vec3::ONE), to_scene * from_cube)
    }

    /// The scene's point `p` in the region's own space, if it lies in the region.
    #[inline]
    #[must_use]
    pub fn locate(&self, p: Vec3) -> Option<Vec3> {
        let local = self.local_point(p);
        self.bounds
            .is_none_or(|b| b.contains(local))
            .then_some(local)
    }

    /// The scene's point `p` in the region's own space.
    #[inline]
    #[must_use]
    pub(crate) fn local_point(&self, p: Vec3) -> Vec3 {
        self.from_scene.transform_point3(p)
    }

    /// The scene's ray in the region's own space, with the same `t`.
    #[inline]
    #[must_use]
    pub(crate) fn local_ray(&self, ray: &Ray) -> Ray {
        ray.transformed(&self.from_scene)
    }

    /// How far rounding may move points of the scene's ray up to distance `t` from those of
    /// [`Self::local_ray`], in the region's own space: infinite or NaN where coordinates overflow.
    #[must_use]
    pub(crate) fn rounding(&self, ray: &Ray, t: f32) -> Vec3 {
        /// Halves of `f32::EPSILON`: 2 of a point, 4 of its transform, 4 of the ray's, 3 of a
        /// distance to a wall, and 16 of the sum of as many distances between walls.
        const ROUNDINGS: f32 = 2.0 + 4.0 + 4.0 + 3.0 + 16.0;
        let far = ray.o.abs() + ray.d.abs() * t;
        let Affine3A {
            matrix3,
            translation,
        } = self.from_scene;
        let sum = matrix3.abs() * far + Vec3::from(translation.abs());
        sum * (ROUNDINGS * 0.5 * f32::EPSILON)
    }

    /// The box in the region's own space; `None` where it is unbounded.
    #[must_use]
    pub const fn bounds(&self) -> Option<&Aabb> {
        self.bounds.as_ref()
    }

    /// Whether the scene's point `p` lies in the region.
    #[inline]
    #[must_use]
    pub fn contains(&self, p: Vec3) -> bool {
        self.bounds.is_none_or(|b| b.contains(self.local_point(p)))
    }

    /// The part of `span` that lies in the region; `None` when it is empty.
    #[must_use]
    pub fn clip(&self, ray: &Ray, span: Span) -> Option<Span> {
        let span = Span::new(span.t0, span.t1)?;
        match &self.bounds {
            None => Some(span),
            Some(bounds) => slabs(bounds, &self.local_ray(ray), span),
        }
    }
}

/// The inverse of a transform; `None` where one of both is not finite.
fn inverse(transform: &Affine3A) -> Option<Affine3A> {
    let m = transform.matrix3;
    // Each axis in a unit of its own, so that the determinant of a large or small scale is a number.
    let unit = |axis: Vec3A| inverse_power_of_two(axis.abs().max_element());
    let units = Vec3A::new(unit(m.x_axis), unit(m.y_axis), unit(m.z_axis));
    let even = Mat3A::from_cols(m.x_axis * units.x, m.y_axis * units.y, m.z_axis * units.z);
    let matrix3 = Mat3A::from_diagonal(units.into()) * even.inverse();
    let inverse = Affine3A {
        matrix3,
        translation: -(matrix3 * transform.translation),
    };
    (transform.is_finite() && inverse.is_finite()).then_some(inverse)
}

/// The part of `span` inside `bounds`, by the slab method; a ray parallel to a face counts as
/// inside while its origin is. `None` where the coordinates of the ray overflow.
fn slabs(bounds: &Aabb, ray: &Ray, span: Span) -> Option<Span> {
    let (mut t0, mut t1) = (span.t0, span.t1);
    for axis in 0..3 {
        let (o, d) = (ray.o[axis], ray.d[axis]);
        if d == 0.0 {
            if !(o >= bounds.min[axis] && o <= bounds.max[axis]) {
                return None;
            }
            continue;
        }
        let (a, b) = ((bounds.min[axis] - o) / d, (bounds.max[axis] - o) / d);
        let (near, far) = if a < b { (a, b) } else { (b, a) };
        if !(near <= far) {
            return None;
        }
        t0 = t0.max(near);
        t1 = t1.min(far);
    }
    Span::new(t0, t1)
}

impl core::fmt::Display for RegionError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Bounds => "the box of a medium must be finite and hold a point",
            Self::Transform => "the transform of a medium must be finite and have an inverse",
        })
    }
}

impl core::error::Error for RegionError {}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: Span = Span {
        t0: 0.0,
        t1: f32::INFINITY,
    };

    #[test]
    fn a_ray_is_clipped_to_the_box_wherever_it_stands() {
        let cube = Aabb::new(Vec3::ZERO, Vec3::ONE);
        let shifted =
            Affine3A::from_translation(Vec3::X * 10.0) * Affine3A::from_scale(Vec3::splat(2.0));
        let region = Region::new(cube, shifted).expect("a box");
        let ray = Ray {
            o: Vec3::new(0.0, 1.0, 1.0),
            d: Vec3::X,
        };
        assert_eq!(
            region.clip(&ray, ALL),
            Some(Span { t0: 10.0, t1: 12.0 }),
            "scene distances"
        );
        assert_eq!(
            region.clip(&Ray { d: Vec3::Y, ..ray }, ALL),
            None,
            "passes by, parallel to faces"
        );
        assert!(
            region.contains(Vec3::new(11.0, 0.5, 2.0)) && !region.contains(Vec3::ZERO),
            "points"
        );
        let inside = Ray {
            o: Vec3::new(11.0, 1.0, 1.0),
            d: Vec3::NEG_X,
        };
        assert_eq!(
            region.clip(&inside, ALL),
            Some(Span { t0: 0.0, t1: 1.0 }),
            "begins inside"
        );
    }

    /// Each entry of the transform is finite, but not the sum of two.
    #[test]
    fn a_ray_whose_coordinates_overflow_crosses_nothing() {
        let cube = Aabb::new(Vec3::ZERO, Vec3::ONE);
        let turned = Affine3A::from_rotation_z(-core::f32::consts::FRAC_PI_4);
        let thin = Affine3A::from_scale(Vec3::new(2.2e-39, 100.0, 1.0));
        let region = Region::new(cube, turned * thin).expect("a box");
        let (across, beside) = (Vec3::new(0.6, -0.6, 0.53), Vec3::new(3.0, -3.0, 0.1));
        let along = Vec3::new(3.0, 3.0, 0.1);
        for (o, d) in [(beside, across), (along, Vec3::Z), (Vec3::ZERO, across)] {
            let ray = Ray { o, d };
            let local = region.local_ray(&ray);
            assert!(!(local.o.is_finite() && local.d.is_finite()), "{local:?}");
            assert_eq!(region.clip(&ray, ALL), None, "{local:?}");
        }
    }

    #[test]
    fn regions_of_any_size_are_as_large_as_they_are() {
        for size in [1e-18, 1e-13, 1.0, 7e12, 1e18] {
            let cube = Aabb::new(Vec3::splat(-0.5), Vec3::splat(0.5));
            let scale = Affine3A::from_scale(Vec3::splat(size));
            let of_box = Aabb::new(cube.min * size, cube.max * size);
            for region in [
                Region::new(cube, scale),
                Region::unit_cube(of_box, Affine3A::IDENTITY),
            ] {
                let region = region.expect("a box");
                assert!(region.contains(Vec3::splat(0.49 * size)), "{size}: inside");
                assert!(
                    !region.contains(Vec3::splat(0.51 * size)),
                    "{size}: outside"
                );
            }
        }
    }

    #[test]
    fn nonsense_is_refused() {
        let cube = Aabb::new(Vec3::ZERO, Vec3::ONE);
        assert_eq!(
            Region::new(Aabb::EMPTY, Affine3A::IDENTITY),
            Err(RegionError::Bounds),
            "empty"
        );
        let flat = Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0));
        assert_eq!(
            Region::new(cube, flat),
            Err(RegionError::Transform),
            "no inverse"
        );
    }
}
