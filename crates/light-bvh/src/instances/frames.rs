use alloc::vec::Vec;

use light_bounds::LightId;

use crate::instances::leaf_ids::LeafIds;
use crate::instances::openings::Openings;
use crate::instances::placed_frame::PlacedFrame;
use crate::light_bvh::LightBvh;
use crate::node::wide_node::{WIDTH, WideNode};
use crate::query::bvh_ref::LightBvhRef;
use crate::query::descent::{AfterLevels, ChosenEntry, Prefetch};
use crate::simd::prefetch;

/// The frames of all placements.
///
/// Where placements are what the upper tree holds they are in its order, so that those of a node
/// are side by side and are prefetched before one of them is chosen. Otherwise several entries of
/// that order share a frame, or are lights, and the frames are in the order of the placements.
#[derive(Clone, Debug)]
pub(crate) struct Frames {
    rows: Vec<PlacedFrame>,
    is_in_tree_order: bool,
}

impl Frames {
    /// The frames of placements that are in their own order, of which `ids` and `openings` say what
    /// the leaves of the upper tree `top` are.
    pub(crate) fn new(
        frames: Vec<PlacedFrame>,
        top: &LightBvh,
        ids: LeafIds,
        openings: &Openings,
    ) -> Self {
        if !(ids.are_placements() && openings.is_empty()) {
            return Self {
                rows: frames,
                is_in_tree_order: false,
            };
        }
        let mut rows = Vec::with_capacity(frames.len());
        rows.extend(top.order.iter().map(|&leaf| frames[leaf as usize]));
        // Dark placements without a place come last.
        let view = top.view();
        let has_no_place = |frame: &PlacedFrame| view.entry(LightId(frame.placement)).is_none();
        rows.extend(frames.into_iter().filter(has_no_place));
        Self {
            rows,
            is_in_tree_order: true,
        }
    }

    /// All of them, in any order.
    pub(crate) fn all(&self) -> &[PlacedFrame] {
        &self.rows
    }

    /// That of a placement, `None` if it has no place.
    #[inline(always)]
    pub(crate) fn of(&self, placement: u32, top: &LightBvhRef<'_>) -> Option<&PlacedFrame> {
        let index = if self.is_in_tree_order {
            top.entry(LightId(placement))?
        } else {
            placement as usize
        };
        self.rows.get(index)
    }

    /// That of the placement of which a part was chosen, and the part; `None` if a light was.
    #[inline(always)]
    pub(crate) fn chosen(
        &self,
        chosen: &ChosenEntry,
        top: &LightBvhRef<'_>,
        ids: LeafIds,
    ) -> Option<(&PlacedFrame, usize)> {
        let (index, part) = if self.is_in_tree_order {
            (chosen.entry, 0)
        } else {
            let (placement, part) = ids.part(top.light(chosen.entry)?.0);
            (placement as usize, part)
        };
        Some((self.rows.get(index)?, part))
    }
}

/// [`AfterLevels::OF_TREE`], with the frames of placements.
impl Prefetch for &Frames {
    #[inline(always)]
    fn below(&self, tree: &LightBvhRef<'_>, level: usize, node: &WideNode) {
        if level < AfterLevels::OF_TREE.0 || tree.is_small() {
            return;
        }
        if self.is_in_tree_order {
            tree.prefetch_nodes_below(node);
            if node.inner < node.count {
                prefetch::<WIDTH, _>(&self.rows, node.light_base);
            }
        } else {
            tree.prefetch_below(node);
        }
    }
}
