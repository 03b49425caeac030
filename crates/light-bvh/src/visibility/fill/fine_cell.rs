use alloc::vec::Vec;
use core::borrow::Borrow;

use light_bounds::{LightId, LightSampleContext};
use light_math::float::sqrt;
use light_math::glam::Vec2;

use crate::node::wide_node::WIDTH;
use crate::query::bvh_ref::LightBvhRef;
use crate::visibility::cell_factors::{CellFactors, CopiedNode, copied_nodes};
use crate::visibility::cell_key::CellKey;
use crate::visibility::fill::bottom_up::factors;
use crate::visibility::fill::coarse_cell::CoarseCell;
use crate::visibility::fill::counts::NodeCounts;
use crate::visibility::fill::mean_importance::mean_importance;
use crate::visibility::fill::options::FillOptions;
use crate::visibility::fill::ray_log::RayLog;
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
    /// The other arguments, and what the result depends on, are those of [`fill`](Self::fill). The
    /// rays go to the lights whose visibility this cell leaves open.
    #[must_use]
    pub fn fill_fine<P: Borrow<LightSampleContext>>(
        &self,
        tree: LightBvhRef<'_>,
        key: CellKey,
        places: &[P],
        options: &FillOptions,
        visible: impl FnMut(&P, LightId, Vec2) -> bool,
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
        let known: Vec<_> = self
            .seen
            .iter()
            .map(|codes| codes.map(decode_share))
            .collect();
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
        rays.in_cell(0, options.fine_rays, cell, |_, _, _| ());
        if rays.log.rays().is_empty() {
            return without_factors;
        }
        let shares = updated_roots(&self.shape, known, &rays.log);
        FineCell {
            key,
            factors: factors(&self.shape, &mean, &shares, options.floor),
        }
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

/// The weight of rays to lights of this visible share: the standard deviation of the result of one
/// ray, and a little for lights that are surely seen.
fn ray_weight(visibility: f32) -> f32 {
    sqrt(visibility * (1.0 - visibility)) + 0.02 * visibility
}

/// The roots of the visible share of each closed child, from the shares `known` before these rays
/// and their results.
fn updated_roots(
    shape: &[CopiedNode],
    mut known: Vec<[f32; WIDTH]>,
    log: &RayLog,
) -> Vec<[f32; WIDTH]> {
    let mut counts = alloc::vec![NodeCounts::default(); shape.len()];
    for ray in log.rays() {
        // A ray counts for the deepest child on its path that the cell knows.
        let (mut place, mut level) = (0, 0);
        let mut child = ray.child(level);
        while let Some(copy) = shape[place].copy_of(child) {
            (place, level) = (copy, level + 1);
            child = ray.child(level);
        }
        counts[place][child].add(ray.is_seen());
    }
    for (known, counts) in known.iter_mut().zip(counts) {
        for (known, counts) in known.iter_mut().zip(counts) {
            *known = sqrt(counts.visibility(*known));
        }
    }
    known
}
