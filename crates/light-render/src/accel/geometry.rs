use core::ops::Range;

use lights::glam::{Vec2, Vec3};
use lights::sources::shape::Sphere;

use super::bvh_hit::BvhHit;
use super::sphere_bvh::SphereBvh;
use super::triangle_bvh::TriangleBvh;
use crate::Ray;

/// The triangles and the spheres of one coordinate system, with consecutive primitive numbers.
#[derive(Default)]
pub(super) struct Geometry {
    triangles: TriangleBvh,
    spheres: SphereBvh,
    first: Numbers,
    count: Numbers,
}

/// A number of a triangle and a number of a sphere.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Numbers {
    pub(super) triangle: u32,
    pub(super) sphere: u32,
}

impl Geometry {
    /// Hierarchies over the corners of `triangles` and over `spheres`, numbered from `next` on,
    /// which counts them.
    ///
    /// # Panics
    /// Panics at 2^32 primitives.
    pub(super) fn new(triangles: &[[Vec3; 3]], spheres: &[Sphere], next: &mut Numbers) -> Self {
        let count = |n| u32::try_from(n).expect("fewer than 2^32 primitives");
        let count = Numbers {
            triangle: count(triangles.len()),
            sphere: count(spheres.len()),
        };
        let first = *next;
        next.triangle += count.triangle;
        next.sphere = next
            .sphere
            .checked_add(count.sphere)
            .expect("fewer than 2^32 primitives");
        Self {
            triangles: TriangleBvh::new(triangles),
            spheres: SphereBvh::new(spheres),
            first,
            count,
        }
    }

    /// How many triangles and spheres there are.
    pub(super) const fn count(&self) -> Numbers {
        self.count
    }

    /// The numbers of all primitives.
    pub(super) fn numbers(&self) -> [Range<u32>; 2] {
        let Self { first, count, .. } = self;
        [
            first.triangle..first.triangle + count.triangle,
            first.sphere..first.sphere + count.sphere,
        ]
    }

    /// The first hit of `ray` nearer than `t_max` that `any_hit` accepts, by number and
    /// coordinates. The triangle `from` is skipped, and so is the near side of the sphere `from`.
    #[inline]
    pub(super) fn closest(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<u32>,
        any_hit: impl Fn(u32, Vec2) -> bool,
    ) -> Option<BvhHit> {
        let Numbers { triangle, sphere } = self.first;
        let start = from.map(|from| from.wrapping_sub(triangle));
        let filter = |number, coords| any_hit(triangle + number, coords);
        let hit = self.triangles.closest(ray, t_max, start, filter);
        let hit = hit.map(|hit| BvhHit {
            number: triangle + hit.number,
            ..hit
        });
        if self.spheres.is_empty() {
            return hit;
        }
        let t_max = hit.map_or(t_max, |hit| hit.t);
        let start = from.map(|from| from.wrapping_sub(sphere));
        let filter = |number, coords| any_hit(sphere + number, coords);
        let nearer = self.spheres.closest(ray, t_max, start, filter);
        let nearer = nearer.map(|hit| BvhHit {
            number: sphere + hit.number,
            ..hit
        });
        nearer.or(hit)
    }

    /// Whether any hit that [`closest`](Self::closest) could return is nearer than `t_max`.
    #[inline]
    pub(super) fn occluded(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<u32>,
        any_hit: impl Fn(u32, Vec2) -> bool,
    ) -> bool {
        let Numbers { triangle, sphere } = self.first;
        let start = from.map(|from| from.wrapping_sub(triangle));
        let filter = |number, coords| any_hit(triangle + number, coords);
        if self.triangles.occluded(ray, t_max, start, filter) {
            return true;
        }
        if self.spheres.is_empty() {
            return false;
        }
        let start = from.map(|from| from.wrapping_sub(sphere));
        let filter = |number, coords| any_hit(sphere + number, coords);
        self.spheres.occluded(ray, t_max, start, filter)
    }
}
