use lights::glam::Vec2;
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::ray::{Ray as ObvhsRay, RayHit};

use super::build::{boxed, over_boxes};
use super::bvh_hit::BvhHit;
use super::quadric_leaf::QuadricLeaf;
use super::quadric_shape::QuadricShape;
use crate::Ray;

/// A binary hierarchy of boxes over quadrics that are stored leaf by leaf.
#[derive(Default)]
pub(super) struct QuadricBvh {
    bvh: Bvh2,
    /// Quadrics in leaf order.
    leaves: Vec<QuadricLeaf>,
}

impl QuadricBvh {
    /// A hierarchy over `quadrics`, whose numbers are the positions in the slice.
    pub(super) fn new(quadrics: &[QuadricShape]) -> Self {
        if quadrics.is_empty() {
            return Self::default();
        }
        let boxes: Vec<_> = quadrics.iter().map(|s| boxed(&s.bounds())).collect();
        let params = BvhBuildParams::medium_build();
        let bvh = over_boxes(&boxes, params);
        let leaf = |&i: &u32| QuadricLeaf::from(&quadrics[i as usize]);
        let leaves = bvh.primitive_indices.iter().map(leaf).collect();
        Self { bvh, leaves }
    }

    #[inline]
    pub(super) fn is_empty(&self) -> bool {
        self.leaves.is_empty()
    }

    /// The first hit of `ray` nearer than `t_max` that `any_hit` accepts, by quadric and
    /// coordinates. Of the quadric `from`, on which the ray starts, only the opposite side is hit.
    // Not inlined: most scenes have no quadrics.
    #[inline(never)]
    pub(super) fn closest(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<u32>,
        any_hit: impl Fn(u32, Vec2) -> bool,
    ) -> Option<BvhHit> {
        let bare = ObvhsRay::new(ray.origin.into(), ray.direction.into(), 0.0, t_max);
        let mut hit = RayHit::none();
        self.bvh.ray_traverse(bare, &mut hit, |bare, slot| {
            self.distance(ray, bare.tmax, slot, from, &any_hit)
        });
        let leaf = self.leaves.get(hit.primitive_id as usize)?;
        Some(BvhHit {
            number: self.bvh.primitive_indices[hit.primitive_id as usize],
            t: hit.t,
            coords: leaf.crossing(ray)?.coords(hit.t),
        })
    }

    /// Whether any hit that [`closest`](Self::closest) could return is nearer than `t_max`.
    #[inline(never)]
    pub(super) fn occluded(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<u32>,
        any_hit: impl Fn(u32, Vec2) -> bool,
    ) -> bool {
        let bare = ObvhsRay::new(ray.origin.into(), ray.direction.into(), 0.0, t_max);
        !self.bvh.ray_traverse_miss(bare, |_, slot| {
            self.distance(ray, t_max, slot, from, &any_hit)
        })
    }

    /// The distance to the quadric in `slot`, infinite without an accepted hit before `t_max`.
    #[inline(always)]
    fn distance(
        &self,
        ray: &Ray,
        t_max: f32,
        slot: usize,
        from: Option<u32>,
        any_hit: impl Fn(u32, Vec2) -> bool,
    ) -> f32 {
        let Some(crossing) = self.leaves[slot].crossing(ray) else {
            return f32::INFINITY;
        };
        let number = self.bvh.primitive_indices[slot];
        let [enters, leaves] = crossing.ends();
        let starts_here = from == Some(number);
        let accepts = |t: f32| {
            t > 0.0 && t < t_max && crossing.is_on(t) && any_hit(number, crossing.coords(t))
        };
        // Rounding decides where a ray enters that starts there; whether it goes inward is certain.
        if !starts_here && accepts(enters) {
            enters
        } else if !(starts_here && crossing.leads_away()) && accepts(leaves) {
            leaves
        } else {
            f32::INFINITY
        }
    }
}
