use light_bounds::{LightId, LightSampleContext, SampledLight};

use crate::importance::receiver::{NoReceiver, Receiver};
use crate::node::wide_node::WideNode;
use crate::query::ascent::Ascent;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::descent::Descent;
use crate::query::into_receiver::{Query, QueryFor};
use crate::query::weights::Weights;
use crate::simd::dispatch;

impl LightBvhRef<'_> {
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
        dispatch(QueryFor(ctx, Descent { tree: self, pmf, u }))
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
        dispatch(QueryFor(
            ctx,
            Ascent {
                tree: self,
                pmf,
                light,
            },
        ))
    }

    /// One light that may light `receiver`; `None` if no light in the tree can.
    #[inline]
    #[must_use]
    pub fn sample_for<R: Receiver>(&self, receiver: &R, u: f64) -> Option<SampledLight> {
        let (tree, pmf) = (self, 1.0);
        dispatch(QueryFor(receiver, Descent { tree, pmf, u }))
    }

    /// Probability that [`sample_for`](Self::sample_for) returns `light`, to the bit.
    #[inline]
    #[must_use]
    pub fn pmf_for<R: Receiver>(&self, receiver: &R, light: LightId) -> f32 {
        let (tree, pmf) = (self, 1.0);
        dispatch(QueryFor(receiver, Ascent { tree, pmf, light }))
    }

    /// One light to emit from, about in proportion to its peak intensity, after another choice of
    /// probability `pmf` led to the tree; `None` if the tree is empty.
    #[must_use]
    pub fn sample_emitter_after(&self, pmf: f32, u: f64) -> Option<SampledLight> {
        dispatch(QueryFor(&NoReceiver, Descent { tree: self, pmf, u }))
    }

    /// Probability that [`sample_emitter_after`](Self::sample_emitter_after) returns `light`, to
    /// the bit.
    #[must_use]
    pub fn pmf_emitter_after(&self, pmf: f32, light: LightId) -> f32 {
        let tree = self;
        dispatch(QueryFor(&NoReceiver, Ascent { tree, pmf, light }))
    }

    /// About the irradiance at `ctx`, or in a medium the fluence, by all lights of a tree of power
    /// 1; 0 only if none of them can contribute.
    #[must_use]
    pub fn irradiance(&self, ctx: &LightSampleContext) -> f64 {
        self.nodes()
            .first()
            .map_or(0.0, |root| dispatch(QueryFor(ctx, Irradiance { root })))
    }
}

/// [`LightBvhRef::irradiance`].
struct Irradiance<'a> {
    root: &'a WideNode,
}

impl Query for Irradiance<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        Weights::new(self.root, receiver).irradiance(self.root)
    }
}
