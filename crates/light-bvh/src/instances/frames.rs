use alloc::vec::Vec;

use light_bounds::LightId;

use crate::instances::leaf_ids::LeafIds;
use crate::instances::openings::Openings;
use crate::instances::placed_frame::PlacedFrame;
use crate::instances::placement::Placement;
use crate::light_bvh::LightBvh;
use crate::node::wide_node::{WIDTH, WideNode};
use crate::query::bvh_ref::LightBvhRef;
use crate::query::descent::{AfterLevels, Prefetch};
use crate::simd::prefetch;

/// The frames of all placements.
///
/// They are in the order of the upper tree, one for each entry, so that those of a node are side by
/// side and are prefetched before one of them is chosen. Where some entries are lights of opened
/// placements, frames are in the order of the placements.
#[derive(Clone, Debug)]
pub(crate) struct Frames {
    rows: Vec<PlacedFrame>,
    is_in_tree_order: bool,
    /// The prototype of each placement.
    prototypes: Vec<u32>,
}

impl Frames {
    /// The frames of `placements`, which are in their own order, and of which `ids` and `openings`
    /// say what the leaves of the upper tree `top` are.
    pub(crate) fn new(
        frames: Vec<PlacedFrame>,
        placements: &[Placement],
        top: &LightBvh,
        ids: LeafIds,
        openings: &Openings,
    ) -> Self {
        let prototypes = placements.iter().map(|placement| placement.prototype);
        let prototypes = prototypes.collect();
        let is_in_tree_order = openings.is_empty();
        let rows = if is_in_tree_order {
            let leaves = top.order.iter();
            leaves.map(|&leaf| frames[ids.placement(leaf)]).collect()
        } else {
            frames
        };
        Self {
            rows,
            is_in_tree_order,
            prototypes,
        }
    }

    /// The prototype of each placement.
    pub(crate) fn prototypes(&self) -> &[u32] {
        &self.prototypes
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.rows) + size_of_val(&*self.prototypes)
    }

    /// That of a leaf which is a part of a placement; `None` if it has no place.
    #[inline(always)]
    pub(crate) fn of(
        &self,
        leaf: LightId,
        top: &LightBvhRef<'_>,
        ids: LeafIds,
    ) -> Option<&PlacedFrame> {
        self.of_entry(top.entry(leaf)?, leaf, ids)
    }

    /// That of an entry of the upper tree, which is this leaf.
    #[inline(always)]
    pub(crate) fn of_entry(
        &self,
        entry: usize,
        leaf: LightId,
        ids: LeafIds,
    ) -> Option<&PlacedFrame> {
        self.rows.get(if self.is_in_tree_order {
            entry
        } else {
            ids.placement(leaf.0)
        })
    }
}

/// [`AfterLevels::OF_TREE`], with the frames of placements.
impl Prefetch for &Frames {
    #[inline(always)]
    fn below(&self, tree: &LightBvhRef<'_>, level: usize, node: &WideNode) {
        if level < AfterLevels::OF_TREE.0 || tree.is_small() {
            return;
        }
        tree.prefetch_below(node);
        if self.is_in_tree_order && usize::from(node.inner) < node.children() {
            prefetch::<WIDTH, _>(&self.rows, node.light_base);
        }
    }
}
