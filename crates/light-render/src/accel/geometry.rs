use core::ops::Range;

use lights::glam::{Vec2, Vec3};

use super::bvh_hit::BvhHit;
use super::quadric_bvh::QuadricBvh;
use super::quadric_shape::QuadricShape;
use super::triangle_bvh::TriangleBvh;
use crate::Ray;

/// The triangles and the quadrics of one coordinate system, with consecutive primitive numbers.
#[derive(Default)]
pub(super) struct Geometry {
    triangles: TriangleBvh,
    quadrics: QuadricBvh,
    first: Numbers,
    count: Numbers,
}

/// A number of a triangle and a number of a quadric.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Numbers {
    pub(super) triangle: u32,
    pub(super) quadric: u32,
}

impl Geometry {
    /// Hierarchies over the corners of `triangles` and over `quadrics`, numbered from `next` on,
    /// which counts them.
    ///
    /// # Panics
    /// Panics at 2^32 primitives.
    pub(super) fn new(
        triangles: &[[Vec3; 3]],
        quadrics: &[QuadricShape],
        next: &mut Numbers,
    ) -> Self {
        let count = |n| u32::try_from(n).expect("fewer than 2^32 primitives");
        let count = Numbers {
            triangle: count(triangles.len()),
            quadric: count(quadrics.len()),
        };
        let first = *next;
        next.triangle += count.triangle;
        next.quadric = next
            .quadric
            .checked_add(count.quadric)
            .expect("fewer than 2^32 primitives");
        Self {
            triangles: TriangleBvh::new(triangles),
            quadrics: QuadricBvh::new(quadrics),
            first,
            count,
        }
    }

    /// How many triangles and quadrics there are.
    pub(super) const fn count(&self) -> Numbers {
        self.count
    }

    /// The numbers of all primitives.
    pub(super) fn numbers(&self) -> [Range<u32>; 2] {
        let Self { first, count, .. } = self;
        [
            first.triangle..first.triangle + count.triangle,
            first.quadric..first.quadric + count.quadric,
        ]
    }

    /// The first hit of `ray` nearer than `t_max` that `any_hit` accepts, by number and
    /// coordinates. The triangle `from` is skipped, and so is the near side of the quadric `from`.
    #[inline]
    pub(super) fn closest(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<u32>,
        any_hit: impl Fn(u32, Vec2) -> bool,
    ) -> Option<BvhHit> {
        let Numbers { triangle, quadric } = self.first;
        let start = from.map(|from| from.wrapping_sub(triangle));
        let filter = |number, coords| any_hit(triangle + number, coords);
        let hit = self.triangles.closest(ray, t_max, start, filter);
        let hit = hit.map(|hit| BvhHit {
            number: triangle + hit.number,
            ..hit
        });
        if self.quadrics.is_empty() {
            return hit;
        }
        let t_max = hit.map_or(t_max, |hit| hit.t);
        let start = from.map(|from| from.wrapping_sub(quadric));
        let filter = |number, coords| any_hit(quadric + number, coords);
        let nearer = self.quadrics.closest(ray, t_max, start, filter);
        let nearer = nearer.map(|hit| BvhHit {
            number: quadric + hit.number,
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
        let Numbers { triangle, quadric } = self.first;
        let start = from.map(|from| from.wrapping_sub(triangle));
        let filter = |number, coords| any_hit(triangle + number, coords);
        if self.triangles.occluded(ray, t_max, start, filter) {
            return true;
        }
        if self.quadrics.is_empty() {
            return false;
        }
        let start = from.map(|from| from.wrapping_sub(quadric));
        let filter = |number, coords| any_hit(quadric + number, coords);
        self.quadrics.occluded(ray, t_max, start, filter)
    }
}
