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
use crate::visibility::fill::gain::Gain;
use crate::visibility::fill::learn::{Learnt, learn};
use crate::visibility::fill::mean_importance::mean_importance;
use crate::visibility::fill::options::FillOptions;
use crate::visibility::fill::ray_log::{CoarseRays, RayLog};
use crate::visibility::fill::rays::Rays;
use crate::visibility::fill::share_code::encode_share;

/// A coarse cell: the nodes of the tree that it copies, the factors of their children, and the
/// visible share of their lights. A plain cell has none of them: queries in it use the tree without
/// factors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CoarseCell {
    pub(super) key: CellKey,
    pub(super) shape: Vec<CopiedNode>,
    pub(super) factors: Vec<[u8; WIDTH]>,
    /// The code of the visible share of each child's lights.
    pub(super) seen: Vec<[u8; WIDTH]>,
    pub(super) rays: CoarseRays,
}

impl CoarseCell {
    /// The cell of `key` by rays from `places` in it: contexts, or a type that lends a context and
    /// holds more for the ray.
    ///
    /// `visible(place, light, u)` returns whether `place` sees the point of `light` that `u` of the
    /// unit square chooses, and `None` if nothing is emitted from there toward `place`: that counts
    /// as not seen, but nothing is in the way. The number of calls is at most that of `options`.
    /// The cell keeps 16 bytes a ray for its fine cells: see
    /// [`without_rays`](Self::without_rays). The same arguments and the same results of
    /// `visible` give the same bytes on every machine: random numbers come from the key, and all
    /// sums have a fixed order. The measurements used 128 places in a coarse cell and 8 in a fine
    /// one.
    ///
    /// # Source
    /// Choices in proportion to the root of a second moment, as in `[Rath2020]`: for a light whose
    /// visibility is 0 or 1 the second moment is its visible share. The expected share, that of the
    /// node above, counts as one more ray: a conjugate prior, as `[Vevoda2018]` has for the
    /// contributions of clusters of lights.
    #[must_use]
    pub fn fill<P: Borrow<LightSampleContext>>(
        tree: LightBvhRef<'_>,
        key: CellKey,
        places: &[P],
        options: &FillOptions,
        visible: impl FnMut(&P, LightId, Vec2) -> Option<bool>,
    ) -> Self {
        let mut rays = Rays {
            tree,
            places,
            key,
            visible,
            log: RayLog::default(),
        };
        rays.by_cuts(0, 0..options.first_rays);
        if rays.log.is_open(options.plain_share) {
            return Self::plain(key);
        }
        rays.by_cuts(0, options.first_rays..options.exploring_rays);
        for round in 1..=2 {
            let cell = Self::learnt(tree, key, places, options, &rays.log);
            let mut gain = Gain::default();
            rays.in_cell(
                round,
                options.guided_rays,
                cell.factors(),
                |place, choice, is_seen| {
                    if round == 2 && is_seen && options.least_gain > 0.0 {
                        gain.add(tree.pmf(place.borrow(), choice.light), choice.pmf);
                    }
                },
            );
            if round == 2 && gain.is_below(options.least_gain) {
                return Self::plain(key);
            }
        }
        let cell = Self::learnt(tree, key, places, options, &rays.log);
        let fine = |place: &P| CellKey::fine(place.borrow(), key.size());
        Self {
            rays: CoarseRays::new(rays.log, places.iter().map(fine).collect()),
            ..cell
        }
    }

    /// A plain cell: nothing blocks its rays, or it has no rays.
    #[must_use]
    pub const fn plain(key: CellKey) -> Self {
        Self {
            key,
            shape: Vec::new(),
            factors: Vec::new(),
            seen: Vec::new(),
            rays: CoarseRays::NONE,
        }
    }

    /// The cell that the rays so far give.
    fn learnt<P: Borrow<LightSampleContext>>(
        tree: LightBvhRef<'_>,
        key: CellKey,
        places: &[P],
        options: &FillOptions,
        log: &RayLog,
    ) -> Self {
        let Learnt { shape, visibility } = learn(&tree, log);
        let nodes = copied_nodes(&tree, &shape).unwrap_or_default();
        let mean = mean_importance(&tree, &nodes[..shape.len()], places);
        let shares: Vec<_> = visibility.iter().map(|v| v.map(sqrt)).collect();
        Self {
            key,
            factors: factors(&shape, &mean, &shares, options.floor),
            seen: visibility.iter().map(|v| v.map(encode_share)).collect(),
            shape,
            rays: CoarseRays::NONE,
        }
    }

    /// The same cell without the rays that filled it, for use when its fine cells are filled: fine
    /// cells made from it learn from their own rays alone.
    #[must_use]
    pub fn without_rays(self) -> Self {
        Self {
            rays: CoarseRays::NONE,
            ..self
        }
    }

    /// Where it is.
    #[must_use]
    pub const fn key(&self) -> CellKey {
        self.key
    }

    /// Whether queries use the tree without factors.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.shape.is_empty()
    }

    /// What queries of the tree need.
    #[must_use]
    pub fn factors(&self) -> CellFactors<'_> {
        CellFactors::of(&self.shape, &self.factors)
    }
}
