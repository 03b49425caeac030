use light_bounds::LightId;

use crate::node::wide_node::{MAX_DEPTH, NOWHERE, WIDTH};
use crate::query::bvh_ref::LightBvhRef;

/// The path of a light: the children that lead from the root to it.
pub(super) struct Way {
    /// `16 * node + child`, the light's first.
    slots: [u32; MAX_DEPTH],
    levels: usize,
}

impl Way {
    /// The path of `light`; `None` if it is not in the tree.
    #[inline(always)]
    pub(super) fn of(tree: &LightBvhRef<'_>, light: LightId) -> Option<Self> {
        let (mut slots, mut levels) = ([0; MAX_DEPTH], 0);
        let mut slot = tree.slot(light);
        while slot != NOWHERE {
            *slots.get_mut(levels)? = slot;
            levels += 1;
            slot = tree.nodes().get(slot as usize / WIDTH)?.parent;
        }
        (levels > 0).then_some(Self { slots, levels })
    }

    /// Node and child of each level, from the root down.
    #[inline(always)]
    pub(super) fn down(&self) -> impl Iterator<Item = (usize, usize)> + use<'_> {
        let slots = self.slots[..self.levels].iter().rev();
        slots.map(|&slot| (slot as usize / WIDTH, slot as usize % WIDTH))
    }
}
