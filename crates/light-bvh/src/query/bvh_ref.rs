use light_bounds::{LightId, LightSampleContext, SampledLight};

use crate::importance::surface::{NoReceiver, Receiver};
use crate::node::wide_node::{NOWHERE, WIDTH, WideNode};
use crate::query::into_receiver::{Oneself, Query};
use crate::query::select::both;
use crate::query::weights::Weights;
use crate::simd::{answer, prefetch};

/// Levels of nodes that a tree may have: the builder keeps to it whatever the lights are.
pub const MAX_DEPTH: usize = 24;

/// How many levels below the start of a descent the caches near a processor hold, and how many nodes of a tree in all: the memory need not be
/// asked early for those.
const CACHED_LEVELS: usize = 2;
const CACHED_NODES: usize = 1 << 8;

/// The default light hierarchy on borrowed memory: what queries need and nothing else.
///
/// Three plain arrays that can be copied to a GPU as they are.
#[derive(Clone, Copy, Debug)]
pub struct LightBvhRef<'a> {
    nodes: &'a [WideNode],
    order: &'a [u32],
    slots: &'a [u32],
}

/// What a slot of a node leads to.
enum Child {
    Node(usize),
    Light(LightId),
}

impl<'a> LightBvhRef<'a> {
    /// A view of the arrays of a [`LightBvh`](crate::LightBvh). Arrays of another origin give answers without meaning, but no panic and no
    /// endless loop.
    #[must_use]
    pub const fn new(nodes: &'a [WideNode], order: &'a [u32], slots: &'a [u32]) -> Self {
        Self {
            nodes,
            order,
            slots,
        }
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

    /// Whether there is no light in the tree.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// One light that may light `ctx`; `None` if no light in the tree can.
    #[inline]
    #[must_use]
    pub fn sample(&self, ctx: &LightSampleContext, u: f64) -> Option<SampledLight> {
        self.sample_after(ctx, 1.0, u)
    }

    /// [`sample`](Self::sample) after another choice of probability `pmf` led to the tree.
    #[inline]
    #[must_use]
    pub fn sample_after(&self, ctx: &LightSampleContext, pmf: f32, u: f64) -> Option<SampledLight> {
        answer(ctx, Sample { tree: self, pmf, u })
    }

    /// Probability that [`sample`](Self::sample) at `ctx` returns `light`, to the bit.
    #[inline]
    #[must_use]
    pub fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.pmf_after(ctx, 1.0, light)
    }

    /// [`pmf`](Self::pmf) after another choice of probability `pmf` led to the tree.
    #[inline]
    #[must_use]
    pub fn pmf_after(&self, ctx: &LightSampleContext, pmf: f32, light: LightId) -> f32 {
        answer(
            ctx,
            Probability {
                tree: self,
                pmf,
                light,
            },
        )
    }

    /// One light that may light `receiver`; `None` if no light in the tree can.
    #[inline]
    #[must_use]
    pub fn sample_for<R: Receiver>(&self, receiver: &R, u: f64) -> Option<SampledLight> {
        let (tree, pmf) = (self, 1.0);
        answer(Oneself(receiver), Sample { tree, pmf, u })
    }

    /// Probability that [`sample_for`](Self::sample_for) returns `light`, to the bit.
    #[inline]
    #[must_use]
    pub fn pmf_for<R: Receiver>(&self, receiver: &R, light: LightId) -> f32 {
        let (tree, pmf) = (self, 1.0);
        answer(Oneself(receiver), Probability { tree, pmf, light })
    }

    /// One light to emit from, about in proportion to its peak intensity, after another choice of probability `pmf` led to the tree;
    /// `None` if the tree is empty.
    #[must_use]
    pub fn sample_emitter_after(&self, pmf: f32, u: f64) -> Option<SampledLight> {
        answer(Oneself(&NoReceiver), Sample { tree: self, pmf, u })
    }

    /// Probability that [`sample_emitter_after`](Self::sample_emitter_after) returns `light`, to the bit.
    #[must_use]
    pub fn pmf_emitter_after(&self, pmf: f32, light: LightId) -> f32 {
        let tree = self;
        answer(Oneself(&NoReceiver), Probability { tree, pmf, light })
    }

    /// About the irradiance at `ctx`, or in a medium the fluence, by all lights of a tree of power 1; 0 only if none of them can contribute.
    #[must_use]
    pub fn irradiance(&self, ctx: &LightSampleContext) -> f64 {
        self.nodes
            .first()
            .map_or(0.0, |root| answer(ctx, Irradiance { root }))
    }

    /// The probability of `light`, if `pmf` is that of the root; or of the first child of a node on the way up from it that `known` tells.
    #[inline(always)]
    pub(crate) fn ascend<R: Receiver>(
        &self,
        receiver: &R,
        pmf: f32,
        light: LightId,
        known: impl Fn(usize, usize) -> Option<f32>,
    ) -> f32 {
        let mut shares = [0.0; MAX_DEPTH];
        let mut slot = self.slot(light);
        if slot == NOWHERE {
            return 0.0;
        }
        let (mut pmf, mut levels) = (pmf, 0);
        // Up along the parents: which nodes to visit does not depend on what they weigh, so their latencies overlap.
        while slot != NOWHERE {
            let (index, child) = (slot as usize / WIDTH, slot as usize % WIDTH);
            if let Some(known) = known(index, child) {
                pmf = known;
                break;
            }
            let (Some(node), Some(share)) = (self.nodes.get(index), shares.get_mut(levels)) else {
                return 0.0;
            };
            *share = Weights::new(node, receiver).probability(child);
            levels += 1;
            slot = node.parent;
        }
        // Multiplied from the root down, as a sample does it.
        shares[..levels]
            .iter()
            .rev()
            .fold(pmf, |pmf, &s| both(pmf, s))
    }

    /// From `node`, which was reached with probability `pmf`, down to a light.
    #[inline(always)]
    pub(crate) fn descend<R: Receiver>(
        &self,
        receiver: &R,
        node: usize,
        pmf: f32,
        u: f64,
    ) -> Option<SampledLight> {
        let (mut index, mut pmf, mut u) = (node, pmf, u);
        for level in 0..MAX_DEPTH {
            let node = self.nodes.get(index)?;
            if level >= CACHED_LEVELS {
                self.prefetch_below(node);
            }
            let choice = Weights::new(node, receiver).choose(u)?;
            pmf = both(pmf, choice.probability);
            u = choice.u;
            match self.child(node, choice.child)? {
                Child::Light(light) => return Some(SampledLight { light, pmf, u }),
                Child::Node(child) => index = child,
            }
        }
        None
    }

    /// From a child of `node`, which was reached with probability `pmf`, down to a light.
    #[inline(always)]
    pub(crate) fn descend_from<R: Receiver>(
        &self,
        receiver: &R,
        node: u32,
        child: usize,
        pmf: f32,
        u: f64,
    ) -> Option<SampledLight> {
        match self.child(self.nodes.get(node as usize)?, child)? {
            Child::Light(light) => Some(SampledLight { light, pmf, u }),
            Child::Node(child) => self.descend(receiver, child, pmf, u),
        }
    }

    /// Asks the memory for what a choice among the children of `node` may lead to, unless the caches hold all of the tree.
    #[inline(always)]
    pub(crate) fn prefetch_below(&self, node: &WideNode) {
        if self.nodes.len() <= CACHED_NODES {
            return;
        }
        prefetch::<WIDTH, _>(self.order, node.light_base);
        if node.inner > 0 {
            prefetch::<WIDTH, _>(self.nodes, node.child_base);
        }
    }

    #[inline(always)]
    fn child(&self, node: &WideNode, child: usize) -> Option<Child> {
        let inner = usize::from(node.inner);
        if child < inner {
            return Some(Child::Node(node.child_base as usize + child));
        }
        let entry = node.light_base as usize + child - inner;
        Some(Child::Light(LightId(*self.order.get(entry)?)))
    }

    #[inline(always)]
    pub(crate) fn slot(&self, light: LightId) -> u32 {
        self.slots.get(light.index()).copied().unwrap_or(NOWHERE)
    }
}

/// [`LightBvhRef::sample_after`].
struct Sample<'a, 'b> {
    tree: &'b LightBvhRef<'a>,
    pmf: f32,
    u: f64,
}

impl Query for Sample<'_, '_> {
    type Answer = Option<SampledLight>;

    #[inline(always)]
    fn of<R: Receiver>(self, receiver: &R) -> Self::Answer {
        self.tree.descend(receiver, 0, self.pmf, self.u)
    }
}

/// [`LightBvhRef::pmf_after`].
struct Probability<'a, 'b> {
    tree: &'b LightBvhRef<'a>,
    pmf: f32,
    light: LightId,
}

impl Query for Probability<'_, '_> {
    type Answer = f32;

    #[inline(always)]
    fn of<R: Receiver>(self, receiver: &R) -> Self::Answer {
        let nothing = |_, _| None;
        self.tree.ascend(receiver, self.pmf, self.light, nothing)
    }
}

/// [`LightBvhRef::irradiance`].
struct Irradiance<'a> {
    root: &'a WideNode,
}

impl Query for Irradiance<'_> {
    type Answer = f64;

    #[inline(always)]
    fn of<R: Receiver>(self, receiver: &R) -> Self::Answer {
        Weights::new(self.root, receiver).irradiance(self.root)
    }
}
