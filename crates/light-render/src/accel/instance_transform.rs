use lights::glam::{Affine3A, Mat3A, Vec3, Vec3A};
use lights::math::Aabb;

use crate::{Ray, Surface};

/// An invertible affine map from the object space of a prototype to world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstanceTransform {
    to_world: Affine3A,
    /// Inverse of the linear part of `to_world`.
    to_object: Mat3A,
}

/// A generous multiple of the rounding error of one component of a transformed point.
const ERROR: f32 = 8.0 * f32::EPSILON;

impl InstanceTransform {
    /// Wraps `to_world`; `None` unless the map and its inverse are finite, and so are the squared
    /// lengths of their columns.
    #[must_use]
    pub fn new(to_world: Affine3A) -> Option<Self> {
        let to_object = to_world.matrix3.inverse();
        let is_good = |matrix: &Mat3A| {
            let squares = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(Vec3A::length_squared);
            squares.iter().sum::<f32>().is_finite()
        };
        let is_good = to_world.is_finite() && is_good(&to_world.matrix3) && is_good(&to_object);
        is_good.then_some(Self {
            to_world,
            to_object,
        })
    }

    /// From object space to world space.
    pub(crate) const fn to_world(self) -> Affine3A {
        self.to_world
    }

    /// Takes a point from object space to world space.
    #[inline]
    #[must_use]
    pub fn point(&self, p: Vec3) -> Vec3 {
        self.to_world.transform_point3(p)
    }

    /// Takes a direction along a surface from object space to world space; the result has any
    /// length.
    #[inline]
    #[must_use]
    pub fn vector(&self, v: Vec3) -> Vec3 {
        self.to_world.transform_vector3(v)
    }

    /// Takes a normal from object space to world space; the result has any length.
    #[inline]
    #[must_use]
    pub fn normal(&self, n: Vec3) -> Vec3 {
        (self.to_object.transpose() * Vec3A::from(n)).into()
    }

    /// Whether the map turns counter-clockwise triangles into clockwise ones.
    #[inline]
    #[must_use]
    pub fn mirrors(&self) -> bool {
        self.to_world.matrix3.determinant() < 0.0
    }

    /// Takes `ray` to object space; also the length there of a unit of world space along the ray.
    ///
    /// The direction is normalised again: the box test takes a ray whose direction components are
    /// near the rounding unit as parallel to the box.
    #[inline]
    #[must_use]
    pub(crate) fn object_ray(&self, ray: &Ray) -> (Ray, f32) {
        let from_here = Vec3A::from(ray.origin) - self.to_world.translation;
        let direction = self.to_object * Vec3A::from(ray.direction);
        let stretch = direction.length();
        let ray = Ray {
            origin: (self.to_object * from_here).into(),
            direction: (direction / stretch).into(),
        };
        (ray, stretch)
    }

    /// Bound, for each component, on the distance in world space by which rounding moves a ray with
    /// origin `p` that is turned into object space.
    #[inline]
    #[must_use]
    pub fn error(&self, p: Vec3) -> Vec3 {
        let from_here = (Vec3A::from(p) - self.to_world.translation).abs();
        let there = self.to_object.abs() * from_here;
        (self.to_world.matrix3.abs() * there * ERROR).into()
    }

    /// Takes a surface point from object space to world space, with its error bound.
    #[must_use]
    pub(crate) fn surface(&self, there: &Surface) -> Surface {
        let p = self.point(there.p);
        let n = self.normal(there.n).normalize_or_zero();
        let spread = self.to_world.matrix3.abs() * Vec3A::from(there.p_error);
        Surface {
            p,
            p_error: Vec3::from(spread) + self.error(p) + p.abs() * ERROR,
            n,
            ns: n,
            ..*there
        }
    }

    /// A world space box around the object space box `bounds`, rounding errors included.
    #[must_use]
    pub fn bounds(&self, bounds: &Aabb) -> Aabb {
        let center = bounds.center();
        let half = Vec3A::from(bounds.max - center);
        let reach = self.to_world.matrix3.abs() * half;
        let largest = self.to_world.matrix3.abs() * (Vec3A::from(center).abs() + half)
            + self.to_world.translation.abs();
        let (center, reach) = (self.point(center), Vec3::from(reach + largest * ERROR));
        Aabb {
            min: center - reach,
            max: center + reach,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lights::glam::Quat;

    fn skewed() -> InstanceTransform {
        let rotation = Quat::from_axis_angle(Vec3::new(1.0, 2.0, -2.0) / 3.0, 1.1);
        let turned = Affine3A::from_quat(rotation);
        let to_world = Affine3A::from_translation(Vec3::new(5.0, -3.0, 100.0))
            * turned
            * Affine3A::from_scale(Vec3::new(-2.0, 0.1, 7.0))
            * turned;
        InstanceTransform::new(to_world).expect("an invertible map")
    }

    #[test]
    fn rays_hit_the_same_point_in_both_spaces() {
        let transform = skewed();
        let p = Vec3::new(0.3, -0.2, 0.9);
        let origin = Vec3::new(7.0, 1.0, 90.0);
        let way = transform.point(p) - origin;
        let direction = way.normalize();
        let (ray, stretch) = transform.object_ray(&Ray { origin, direction });
        assert!(
            (ray.direction.length() - 1.0).abs() < 1e-6,
            "of unit length"
        );
        let there = ray.at(way.length() * stretch);
        assert!(there.distance(p) < 1e-4, "{there} is {p}");
    }

    #[test]
    fn normals_stay_normals_and_boxes_contain() {
        let transform = skewed();
        let [a, b, c] = [Vec3::X, Vec3::new(0.1, 0.9, 0.0), Vec3::splat(-0.5)];
        let n = transform.normal((b - a).cross(c - a)).normalize();
        let [p, q, r] = [a, b, c].map(|v| transform.point(v));
        let across = (q - p).cross(r - p).normalize();
        assert!(transform.mirrors(), "one scale is negative");
        assert!(n.distance(-across) < 1e-5, "mirrored, the front stays");
        let bounds = transform.bounds(&Aabb::from_points([a, b, c]));
        assert!([p, q, r].iter().all(|&v| bounds.contains(v)), "in the box");
    }

    #[test]
    fn singular_and_non_finite_maps_are_refused() {
        let flat = Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0));
        let nowhere = Affine3A::from_translation(Vec3::NAN);
        let huge = Affine3A::from_scale(Vec3::splat(1e30));
        for bad in [flat, nowhere, huge] {
            assert_eq!(InstanceTransform::new(bad), None, "{bad}");
        }
    }
}
