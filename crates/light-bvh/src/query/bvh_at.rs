use light_bounds::{LightId, SampledLight};

use crate::importance::context_receiver::ContextReceiver;
use crate::importance::receiver::Receiver;
use crate::query::ascent::KnownPmfs;
use crate::query::bvh_ref::LightBvhRef;
#[cfg(feature = "alloc")]
use crate::query::descent::{ChosenEntry, Prefetch};
use crate::query::into_receiver::{IntoReceiver, KeptReceiver, Query, QueryFor};
use crate::query::weights::Weights;
use crate::simd::dispatch;

/// A tree as one receiver sees it: the root is evaluated once for all queries.
///
/// The probabilities have the bits of [`LightBvhRef::sample`] and [`LightBvhRef::pmf`].
#[derive(Clone, Copy, Debug)]
pub struct LightBvhAt<'a, R = ContextReceiver> {
    tree: LightBvhRef<'a>,
    receiver: R,
    root: Weights,
}

impl<'a> LightBvhRef<'a> {
    /// The tree as `receiver` sees it.
    #[must_use]
    pub fn at<A: IntoReceiver>(&self, receiver: A) -> LightBvhAt<'a, A::Kept> {
        let tree = self.wanting(receiver.groups());
        let receiver = receiver.keep();
        LightBvhAt {
            tree,
            receiver,
            root: dispatch(QueryFor(&receiver, Root { tree: &tree })),
        }
    }
}

impl<R: KeptReceiver> LightBvhAt<'_, R> {
    /// About the irradiance, or in a medium the fluence, by all lights of a tree of power 1; 0 only
    /// if none of them can contribute.
    #[inline]
    #[must_use]
    pub fn irradiance(&self) -> f32 {
        let root = self.tree.nodes().first();
        root.map_or(0.0, |root| self.root.irradiance(root))
    }

    /// One light that may light the receiver; `None` if no light in the tree can.
    #[must_use]
    pub fn sample(&self, u: u64) -> Option<SampledLight> {
        dispatch(QueryFor(&self.receiver, FromRoot { at: self, u }))
    }

    /// Probability that [`sample`](Self::sample) returns `light`, to the bit.
    #[must_use]
    pub fn pmf(&self, light: LightId) -> f32 {
        dispatch(QueryFor(&self.receiver, ToRoot { at: self, light }))
    }
}

#[cfg(feature = "alloc")]
impl<R: KeptReceiver> LightBvhAt<'_, R> {
    /// [`sample`](Self::sample) as an entry of the order.
    #[inline(always)]
    pub(crate) fn sample_entry(&self, u: u64, prefetch: impl Prefetch) -> Option<ChosenEntry> {
        let at = self;
        dispatch(QueryFor(&self.receiver, EntryFromRoot { at, u, prefetch }))
    }
}

/// The weights of the root's children.
struct Root<'a, 'b> {
    tree: &'b LightBvhRef<'a>,
}

impl Query for Root<'_, '_> {
    type Output = Weights;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Weights {
        // Not by a closure, which would be compiled for narrow vectors.
        match self.tree.nodes().first() {
            Some(root) => self.tree.weights(0, root, receiver),
            None => Weights::NONE,
        }
    }
}

/// [`LightBvhAt::sample`].
struct FromRoot<'a, 'b, K> {
    at: &'b LightBvhAt<'a, K>,
    u: u64,
}

impl<K> Query for FromRoot<'_, '_, K> {
    type Output = Option<SampledLight>;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        let LightBvhAt { tree, root, .. } = self.at;
        tree.descend_from(receiver, 0, 1.0, &root.choose(self.u)?)
    }
}

/// [`LightBvhAt::sample_entry`].
#[cfg(feature = "alloc")]
struct EntryFromRoot<'a, 'b, K, P> {
    at: &'b LightBvhAt<'a, K>,
    u: u64,
    prefetch: P,
}

#[cfg(feature = "alloc")]
impl<K, P: Prefetch> Query for EntryFromRoot<'_, '_, K, P> {
    type Output = Option<ChosenEntry>;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        let LightBvhAt { tree, root, .. } = self.at;
        let choice = root.choose(self.u)?;
        tree.entry_from(receiver, &self.prefetch, 0, 1.0, &choice)
    }
}

/// [`LightBvhAt::pmf`].
struct ToRoot<'a, 'b, K> {
    at: &'b LightBvhAt<'a, K>,
    light: LightId,
}

impl<K> Query for ToRoot<'_, '_, K> {
    type Output = f32;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> f32 {
        let LightBvhAt { tree, root, .. } = self.at;
        tree.ascend(receiver, self.light, root)
    }
}

/// The weights of the root's children.
impl KnownPmfs for Weights {
    #[inline(always)]
    fn pmf(&self, node: usize, child: usize) -> Option<f32> {
        if node == 0 {
            Some(self.probability(child))
        } else {
            None
        }
    }
}
