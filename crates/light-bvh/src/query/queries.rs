use light_bounds::{LightGroups, LightId, SampledLight};

use crate::importance::receiver::NoReceiver;
use crate::query::ascent::Ascent;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::descent::{AfterLevels, Descent};
#[cfg(feature = "alloc")]
use crate::query::descent::{ChosenEntry, EntryDescent, Prefetch};
use crate::query::into_receiver::{IntoReceiver, KeptReceiver, QueryFor};
use crate::simd::dispatch;

/// A `receiver` is a reference to a [`LightSampleContext`](light_bounds::LightSampleContext), or to
/// a [`Receiver`](crate::Receiver). `u` is a [fraction](light_math::fraction) of 2^64.
impl LightBvhRef<'_> {
    /// One light that may light `receiver`; `None` if no light in the tree can.
    #[must_use]
    pub fn sample(&self, receiver: impl IntoReceiver, u: u64) -> Option<SampledLight> {
        self.sample_for(&receiver.keep(), receiver.groups(), u)
    }

    /// Probability that [`sample`](Self::sample) for `receiver` returns `light`, to the bit.
    #[must_use]
    pub fn pmf(&self, receiver: impl IntoReceiver, light: LightId) -> f32 {
        self.pmf_for(&receiver.keep(), receiver.groups(), light)
    }

    /// [`sample`](Self::sample) of the lights in some groups.
    #[inline(always)]
    pub(crate) fn sample_for<R: KeptReceiver>(
        &self,
        receiver: &R,
        groups: LightGroups,
        u: u64,
    ) -> Option<SampledLight> {
        let tree = &self.wanting(groups);
        tree.sample_below(receiver, 0, u)
    }

    /// The same from the node `root` on.
    #[inline(always)]
    pub(crate) fn sample_below<R: KeptReceiver>(
        &self,
        receiver: &R,
        root: usize,
        u: u64,
    ) -> Option<SampledLight> {
        let query = Descent {
            tree: self,
            root,
            u,
            prefetch: AfterLevels::OF_TREE,
        };
        dispatch(QueryFor(receiver, query))
    }

    /// The same as an entry of the order.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn sample_entry<R: KeptReceiver>(
        &self,
        receiver: &R,
        groups: LightGroups,
        u: u64,
        prefetch: impl Prefetch,
    ) -> Option<ChosenEntry> {
        let tree = &self.wanting(groups);
        dispatch(QueryFor(receiver, EntryDescent { tree, u, prefetch }))
    }

    /// [`pmf`](Self::pmf) of the lights in some groups.
    #[inline(always)]
    pub(crate) fn pmf_for<R: KeptReceiver>(
        &self,
        receiver: &R,
        groups: LightGroups,
        light: LightId,
    ) -> f32 {
        let tree = &self.wanting(groups);
        dispatch(QueryFor(receiver, Ascent { tree, light }))
    }

    /// One light to emit from, about in proportion to its peak intensity; `None` if the tree is
    /// empty.
    #[must_use]
    pub fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.sample(&NoReceiver, u)
    }

    /// Probability that [`sample_emitter`](Self::sample_emitter) returns `light`, to the bit.
    #[must_use]
    pub fn pmf_emitter(&self, light: LightId) -> f32 {
        self.pmf(&NoReceiver, light)
    }
}
