use light_bounds::{LightGroups, LightId};

#[cfg(feature = "alloc")]
use crate::importance::child_view::NodeFrame;
#[cfg(feature = "alloc")]
use crate::importance::context_receiver::ContextReceiver;
use crate::importance::receiver::Receiver;
use crate::node::wide_node::{NOWHERE, WIDTH, WideNode};
use crate::query::weights::Weights;
use crate::simd::{prefetch, prefetch_ends};

/// How many nodes the caches hold: a smaller tree is not prefetched.
const CACHED_NODES: usize = 1 << 8;

/// The default light hierarchy on borrowed slices: all that queries need.
///
/// Three plain arrays that can be copied to a GPU as they are.
#[derive(Clone, Copy, Debug)]
pub struct LightBvhRef<'a> {
    nodes: &'a [WideNode],
    order: &'a [u32],
    slots: &'a [u32],
    /// The groups of the lights of each child of each node; empty if nothing is left out by them.
    groups: &'a [[LightGroups; WIDTH]],
    /// The groups to choose from.
    wanted: LightGroups,
}

/// What a slot of a node leads to.
pub(crate) enum Child {
    Node(usize),
    /// The light of this entry of the order.
    Entry(usize),
}

/// The groups of all children of a node together.
#[cfg(any(feature = "alloc", feature = "bytemuck"))]
pub(crate) fn groups_of_all(children: &[LightGroups; WIDTH]) -> LightGroups {
    let all = children.iter().copied();
    all.fold(LightGroups::NONE, core::ops::BitOr::bitor)
}

impl<'a> LightBvhRef<'a> {
    /// A view of the arrays of a [`LightBvh`](crate::LightBvh). Other arrays give meaningless
    /// results, but neither a panic nor an endless loop.
    #[must_use]
    pub const fn new(nodes: &'a [WideNode], order: &'a [u32], slots: &'a [u32]) -> Self {
        Self {
            nodes,
            order,
            slots,
            groups: &[],
            wanted: LightGroups::ALL,
        }
    }

    /// The same tree with the groups of its lights, for each child of each node: those of
    /// [`LightBvh::groups`](crate::LightBvh::groups). Without them all lights are in all groups.
    #[must_use]
    pub const fn with_groups(self, groups: &'a [[LightGroups; WIDTH]]) -> Self {
        Self { groups, ..self }
    }

    /// The tree for a context of these groups.
    #[inline(always)]
    pub(crate) const fn wanting(self, wanted: LightGroups) -> Self {
        if wanted.0 == LightGroups::ALL.0 {
            let groups = &[];
            Self { groups, ..self }
        } else {
            Self { wanted, ..self }
        }
    }

    /// The weights of the children of the node `index`: 0 for those without a light in the
    /// requested groups.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn weights<R: Receiver>(
        &self,
        index: usize,
        node: &WideNode,
        receiver: &R,
    ) -> Weights {
        let mut weights = Weights::new(node, receiver);
        self.look_ahead(node, receiver, &mut weights);
        self.leave_out(index, &mut weights);
        self.cap_uncertain(node, receiver, &mut weights);
        weights
    }

    /// Sets the weights of children without a light in the requested groups to 0.
    #[inline(always)]
    pub(crate) fn leave_out(&self, index: usize, weights: &mut Weights) {
        if let Some(groups) = self.groups.get(index) {
            weights.keep(groups, self.wanted);
        }
    }

    /// Whether `receiver` may get other shares of the powers of the lights in a slot.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn tells_apart(&self, receiver: &ContextReceiver, slot: usize) -> bool {
        let Some(node) = self.nodes.get(slot / WIDTH) else {
            return true;
        };
        let frame = NodeFrame::in_codes(node, receiver.position());
        let child = frame.child_at(node, slot % WIDTH, node.has_rare());
        receiver.tells_apart(&child)
    }

    /// The nodes, the root first.
    #[must_use]
    pub const fn nodes(&self) -> &'a [WideNode] {
        self.nodes
    }

    /// The lights as the nodes refer to them.
    #[must_use]
    pub const fn order(&self) -> &'a [u32] {
        self.order
    }

    /// The place of each light: `16 * node + child`, all ones for a light that is not in the tree.
    #[must_use]
    pub const fn slots(&self) -> &'a [u32] {
        self.slots
    }

    /// The groups of the lights of each child of each node; empty without groups.
    #[must_use]
    pub const fn groups(&self) -> &'a [[LightGroups; WIDTH]] {
        self.groups
    }

    /// Whether there is no light in the tree.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Prefetches all that a choice among the children of `node` may lead to, unless the tree is
    /// small.
    #[inline(always)]
    pub(crate) fn prefetch_below(&self, node: &WideNode) {
        if self.is_small() {
            return;
        }
        prefetch::<WIDTH, _>(self.order, node.light_base);
        self.prefetch_nodes_below(node);
    }

    /// Whether the caches hold the whole tree.
    #[inline(always)]
    pub(crate) const fn is_small(&self) -> bool {
        self.nodes.len() <= CACHED_NODES
    }

    /// Prefetches the nodes that a choice among the children of `node` may lead to.
    #[inline(always)]
    pub(crate) fn prefetch_nodes_below(&self, node: &WideNode) {
        if node.inner > 0 {
            prefetch_ends::<WIDTH, _>(self.nodes, node.child_base);
        }
    }

    /// What slot `child` of `node` leads to.
    #[inline(always)]
    pub(crate) fn child(&self, node: &WideNode, child: usize) -> Child {
        let inner = usize::from(node.inner);
        if child < inner {
            Child::Node(node.child_base as usize + child)
        } else {
            Child::Entry(node.light_base as usize + child - inner)
        }
    }

    /// The light of an entry of the order; `None` for arrays of another origin.
    #[inline(always)]
    pub(crate) fn light(&self, entry: usize) -> Option<LightId> {
        Some(LightId(*self.order.get(entry)?))
    }

    /// The entry of the order that `light` has, if it has a place.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn entry(&self, light: LightId) -> Option<usize> {
        let slot = self.slot(light) as usize;
        let node = self.nodes.get(slot / WIDTH)?;
        (node.light_base as usize + slot % WIDTH).checked_sub(usize::from(node.inner))
    }

    /// The place of `light`; [`NOWHERE`] if it has none.
    #[inline(always)]
    pub(crate) fn slot(&self, light: LightId) -> u32 {
        self.slots.get(light.index()).copied().unwrap_or(NOWHERE)
    }
}
