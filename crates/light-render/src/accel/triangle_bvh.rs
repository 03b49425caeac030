use lights::glam::{Vec2, Vec3};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::ray::{Ray as ObvhsRay, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;

use super::build::over_triangles;
use super::bvh_hit::BvhHit;
use crate::Ray;

/// The nearest hit. In a plane through zero a ray starts without an offset, and triangles there
/// would be hit at distance 0.
const T_MIN: f32 = f32::MIN_POSITIVE;

/// A binary hierarchy of boxes over triangles that are stored leaf by leaf.
#[derive(Default)]
pub(super) struct TriangleBvh {
    bvh: Bvh2,
    /// Triangles in leaf order; a triangle that the builder split is in several leaves.
    leaves: Vec<RtTriangle>,
}

impl TriangleBvh {
    /// A hierarchy over the corners of `triangles`, whose numbers are the positions in the slice.
    pub(super) fn new(triangles: &[[Vec3; 3]]) -> Self {
        let triangles: Vec<Triangle> = triangles
            .iter()
            .map(|&[a, b, c]| Triangle {
                v0: a.into(),
                v1: b.into(),
                v2: c.into(),
            })
            .collect();
        if triangles.is_empty() {
            return Self::default();
        }
        // Splitting gains most for the long triangles of buildings, but takes too much memory for
        // the largest scenes.
        let params = if triangles.len() < 1 << 20 {
            BvhBuildParams::slow_build()
        } else {
            BvhBuildParams::medium_build()
        };
        let bvh = over_triangles(&triangles, params);
        let leaves = bvh
            .primitive_indices
            .iter()
            .map(|&i| (&triangles[i as usize]).into())
            .collect();
        Self { bvh, leaves }
    }

    /// The first hit of `ray` nearer than `t_max` that `any_hit` accepts, by triangle and
    /// barycentric coordinates. The triangle `from` is skipped.
    #[inline]
    pub(super) fn closest(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<u32>,
        any_hit: impl Fn(u32, Vec2) -> bool,
    ) -> Option<BvhHit> {
        let ray = ObvhsRay::new(ray.origin.into(), ray.direction.into(), T_MIN, t_max);
        let mut hit = RayHit::none();
        self.bvh.ray_traverse(ray, &mut hit, |ray, slot| {
            self.distance(ray, slot, from, &any_hit)
        });
        let leaf = self.leaves.get(hit.primitive_id as usize)?;
        Some(BvhHit {
            number: self.bvh.primitive_indices[hit.primitive_id as usize],
            t: hit.t,
            coords: leaf.compute_barycentric(&ray),
        })
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
        let ray = ObvhsRay::new(ray.origin.into(), ray.direction.into(), T_MIN, t_max);
        !self
            .bvh
            .ray_traverse_miss(ray, |ray, slot| self.distance(ray, slot, from, &any_hit))
    }

    /// The distance to the triangle in `slot`, infinite for a miss, for the triangle that the ray
    /// starts on, and for a hit that `any_hit` rejects.
    #[inline(always)]
    fn distance(
        &self,
        ray: &ObvhsRay,
        slot: usize,
        from: Option<u32>,
        any_hit: impl Fn(u32, Vec2) -> bool,
    ) -> f32 {
        let leaf = &self.leaves[slot];
        let t = leaf.intersect(ray);
        if t < f32::INFINITY {
            let number = self.bvh.primitive_indices[slot];
            if from == Some(number) || !any_hit(number, leaf.compute_barycentric(ray)) {
                return f32::INFINITY;
            }
        }
        t
    }
}
