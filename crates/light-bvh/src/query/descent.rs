use light_bounds::SampledLight;
use light_math::float::positive_product;

use crate::importance::receiver::Receiver;
#[cfg(feature = "alloc")]
use crate::node::wide_node::WIDTH;
use crate::node::wide_node::{MAX_DEPTH, WideNode};
use crate::query::bvh_ref::{Child, LightBvhRef};
use crate::query::into_receiver::Query;
use crate::query::select::Choice;

/// What a descent prefetches on its way.
pub(crate) trait Prefetch {
    /// Prefetches what a choice among the children of `node` may lead to, which is so many levels
    /// below the start.
    fn below(&self, tree: &LightBvhRef<'_>, level: usize, node: &WideNode);
}

/// Nodes and lights this many levels below the start and deeper: the caches hold those above.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AfterLevels(pub(crate) usize);

impl AfterLevels {
    /// In a tree of its own.
    pub(crate) const OF_TREE: Self = Self(2);
    /// In a prototype: the caches hold the first two levels of all prototypes, if these are few.
    #[cfg(feature = "alloc")]
    pub(crate) const OF_PROTOTYPE: Self = Self(1);
}

impl Prefetch for AfterLevels {
    #[inline(always)]
    fn below(&self, tree: &LightBvhRef<'_>, level: usize, node: &WideNode) {
        if level >= self.0 {
            tree.prefetch_below(node);
        }
    }
}

/// An entry of a tree's order that was chosen, the probability of that, and the unused part of `u`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChosenEntry {
    pub(crate) entry: usize,
    /// Its place in the tree: that of a child of a node.
    #[cfg(feature = "alloc")]
    pub(crate) slot: usize,
    pub(crate) pmf: f32,
    pub(crate) u: u64,
}

/// The choice of a light.
pub(crate) struct Descent<'a, 'b, P> {
    pub(crate) tree: &'b LightBvhRef<'a>,
    /// The node that it starts at.
    pub(crate) root: usize,
    pub(crate) u: u64,
    pub(crate) prefetch: P,
}

impl<P: Prefetch> Query for Descent<'_, '_, P> {
    type Output = Option<SampledLight>;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        let Self {
            tree,
            root,
            u,
            prefetch,
        } = self;
        tree.light_of(&tree.descend(receiver, &prefetch, root, 1.0, u)?)
    }
}

/// The choice of an entry of the order.
#[cfg(feature = "alloc")]
pub(crate) struct EntryDescent<'a, 'b, P> {
    pub(crate) tree: &'b LightBvhRef<'a>,
    pub(crate) u: u64,
    pub(crate) prefetch: P,
}

#[cfg(feature = "alloc")]
impl<P: Prefetch> Query for EntryDescent<'_, '_, P> {
    type Output = Option<ChosenEntry>;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        let Self { tree, u, prefetch } = self;
        tree.descend(receiver, &prefetch, 0, 1.0, u)
    }
}

impl LightBvhRef<'_> {
    /// From `node`, which was reached with probability `pmf`, down to an entry of the order.
    #[inline(always)]
    fn descend<R: Receiver>(
        &self,
        receiver: &R,
        prefetch: &impl Prefetch,
        node: usize,
        pmf: f32,
        u: u64,
    ) -> Option<ChosenEntry> {
        let (mut index, mut pmf, mut u) = (node, pmf, u);
        for level in 0..MAX_DEPTH {
            let node = self.nodes().get(index)?;
            prefetch.below(self, level, node);
            let weights = self.weights(index, node, receiver);
            let choice = weights.choose(u)?;
            pmf = positive_product(pmf, choice.probability);
            u = choice.u;
            match self.child(node, choice.child) {
                Child::Entry(entry) => {
                    return Some(ChosenEntry {
                        entry,
                        #[cfg(feature = "alloc")]
                        slot: WIDTH * index + choice.child,
                        pmf,
                        u,
                    });
                }
                Child::Node(child) => index = child,
            }
        }
        None
    }

    /// From the `choice` of a child of `node`, which was reached with probability `pmf`, down to a
    /// light.
    #[inline(always)]
    pub(crate) fn descend_from<R: Receiver>(
        &self,
        receiver: &R,
        node: u32,
        pmf: f32,
        choice: &Choice,
    ) -> Option<SampledLight> {
        let prefetch = &AfterLevels::OF_TREE;
        self.light_of(&self.entry_from(receiver, prefetch, node, pmf, choice)?)
    }

    /// The same, down to an entry of the order.
    #[inline(always)]
    pub(crate) fn entry_from<R: Receiver>(
        &self,
        receiver: &R,
        prefetch: &impl Prefetch,
        node: u32,
        pmf: f32,
        choice: &Choice,
    ) -> Option<ChosenEntry> {
        let pmf = positive_product(pmf, choice.probability);
        let u = choice.u;
        match self.child(self.nodes().get(node as usize)?, choice.child) {
            Child::Entry(entry) => Some(ChosenEntry {
                entry,
                #[cfg(feature = "alloc")]
                slot: WIDTH * node as usize + choice.child,
                pmf,
                u,
            }),
            Child::Node(child) => self.descend(receiver, prefetch, child, pmf, u),
        }
    }

    /// The light of a chosen entry.
    #[inline(always)]
    pub(crate) fn light_of(&self, chosen: &ChosenEntry) -> Option<SampledLight> {
        let &ChosenEntry { entry, pmf, u, .. } = chosen;
        let light = self.light(entry)?;
        Some(SampledLight { light, pmf, u })
    }
}
