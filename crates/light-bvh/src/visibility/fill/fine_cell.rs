use alloc::vec::Vec;
use core::borrow::Borrow;

use light_bounds::{LightId, LightSampleContext};
use light_math::float::sqrt;
use light_math::glam::Vec2;

use crate::node::wide_node::WIDTH;
use crate::query::bvh_ref::LightBvhRef;
use crate::visibility::cell_factors::{CellFactors, CopiedNode, copied_nodes};
use crate::visibility::cell_key::CellKey;
use crate::visibility::fill::bottom_up::{closed_children, factors};
use crate::visibility::fill::coarse_cell::CoarseCell;
use crate::visibility::fill::counts::NodeCounts;
use crate::visibility::fill::mean_importance::mean_importance;
use crate::visibility::fill::options::FillOptions;
use crate::visibility::fill::ray_log::{Ray, RayLog};
use crate::visibility::fill::rays::Rays;
use crate::visibility::fill::share_code::decode_share;

/// A fine cell: its own factors for the children of the nodes that its coarse cell copies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FineCell {
    pub(super) key: CellKey,
    /// Empty if the factors of the coarse cell are used.
    pub(super) factors: Vec<[u8; WIDTH]>,
}

impl CoarseCell {
    /// The fine cell of `key` in this one, by rays from `places` in it. Without places, or rays, it
    /// has the factors of this cell; in a plain cell it is plain, and no ray is sent.
    ///
    /// The other arguments, and what the result depends on, are those of [`fill`](Self::fill). Rays
    /// of this cell from places in the fine one count for it. Its own go to the lights whose
    /// visibility those leave open, and are as many as that is worth: none where each light is known
    /// to be seen or hidden.
    #[must_use]
    pub fn fill_fine<P: Borrow<LightSampleContext>>(
        &self,
        tree: LightBvhRef<'_>,
        key: CellKey,
        places: &[P],
        options: &FillOptions,
        visible: impl FnMut(&P, LightId, Vec2) -> Option<bool>,
    ) -> FineCell {
        let without_factors = FineCell {
            key,
            factors: Vec::new(),
        };
        if self.is_plain() {
            return without_factors;
        }
        let nodes = copied_nodes(&tree, &self.shape).unwrap_or_default();
        let mean = mean_importance(&tree, &nodes[..self.shape.len()], places);
        let mut counts = alloc::vec![NodeCounts::default(); self.shape.len()];
        add(&mut counts, &self.shape, self.rays.of(key));
        let known = self.shares(&counts);
        // Rays go where their results are least certain, not where the light is.
        let weights: Vec<_> = known.iter().map(|shares| shares.map(ray_weight)).collect();
        let ray_factors = factors(&self.shape, &mean, &weights, options.floor);
        let mut rays = Rays {
            tree,
            places,
            key,
            visible,
            log: RayLog::default(),
        };
        let cell = CellFactors::of(&self.shape, &ray_factors);
        let count = share_of(options.fine_rays, doubt(&self.shape, &mean, &known));
        rays.in_cell(0, count, cell, |_, _, _| ());
        if rays.log.rays().is_empty() {
            return without_factors;
        }
        add(&mut counts, &self.shape, rays.log.rays().iter().copied());
        let shares = self.shares(&counts);
        let shares: Vec<_> = shares.iter().map(|shares| shares.map(sqrt)).collect();
        FineCell {
            key,
            factors: factors(&self.shape, &mean, &shares, options.floor),
        }
    }

    /// The visible share of each closed child, from that of this cell and the rays of a fine one.
    fn shares(&self, counts: &[NodeCounts]) -> Vec<[f32; WIDTH]> {
        let of_node = |(known, counts): (&[u8; WIDTH], &NodeCounts)| {
            core::array::from_fn(|child| counts[child].visibility(decode_share(known[child])))
        };
        self.seen.iter().zip(counts).map(of_node).collect()
    }
}

impl FineCell {
    /// Where it is.
    #[must_use]
    pub const fn key(&self) -> CellKey {
        self.key
    }

    /// What queries of the tree need; `coarse` is the cell that it was made from.
    #[must_use]
    pub fn factors<'a>(&'a self, coarse: &'a CoarseCell) -> CellFactors<'a> {
        if self.factors.is_empty() {
            coarse.factors()
        } else {
            CellFactors::of(&coarse.shape, &self.factors)
        }
    }
}

/// The standard deviation of the result of one ray to lights of this visible share.
fn ray_deviation(visibility: f32) -> f32 {
    sqrt(visibility * (1.0 - visibility))
}

/// The weight of rays to lights of this visible share: their deviation, and a little for lights that
/// are surely seen.
fn ray_weight(visibility: f32) -> f32 {
    ray_deviation(visibility) + 0.02 * visibility
}

/// How uncertain the result of a ray is, over the root of the visible share that lights are chosen
/// by: means over all closed children, by importance. From 0 to 1.
fn doubt(shape: &[CopiedNode], mean: &[[f32; WIDTH]], shares: &[[f32; WIDTH]]) -> f32 {
    let (mut deviation, mut chosen) = (0.0, 0.0);
    for (importance, share) in closed_children(shape, mean, shares) {
        deviation += importance * ray_deviation(share);
        chosen += importance * sqrt(share);
    }
    if chosen > 0.0 {
        deviation / chosen
    } else {
        0.0
    }
}

/// A share of so many rays, to the next lower number.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "from 0 to `rays`"
)]
fn share_of(rays: u32, share: f32) -> u32 {
    (rays as f32 * share) as u32
}

/// Adds each ray to the deepest child on its path that the cell knows.
fn add(counts: &mut [NodeCounts], shape: &[CopiedNode], rays: impl Iterator<Item = Ray>) {
    for ray in rays {
        let (mut place, mut level) = (0, 0);
        let mut child = ray.child(level);
        while let Some(copy) = shape[place].copy_of(child) {
            (place, level) = (copy, level + 1);
            child = ray.child(level);
        }
        counts[place][child].add(ray.is_seen());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubt_is_left_where_lights_are_neither_seen_nor_hidden() {
        let of = |shares: [f32; 2]| {
            let row = |values: &[f32; 2]| {
                core::array::from_fn(|child| values.get(child).copied().unwrap_or(0.0))
            };
            doubt(
                &[CopiedNode::default()],
                &[row(&[3.0, 1.0])],
                &[row(&shares)],
            )
        };
        assert_eq!(of([1.0, 0.0]), 0.0, "all is known");
        assert_eq!(of([0.0, 0.0]), 0.0, "nothing arrives");
        assert_eq!(of([0.25, 0.25]), sqrt(0.75), "a quarter of both");
        assert_eq!(of([1.0, 0.36]), 0.48 / 3.6, "the root of it of one");
        assert_eq!(share_of(192, 0.5), 96);
        assert_eq!(share_of(1, 0.99), 0);
    }
}
