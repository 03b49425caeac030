use core::ops::ControlFlow;

use light_bounds::{LightSampleContext, SampledLight};

use crate::importance::receiver::Receiver;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::into_receiver::{Query, QueryFor};
use crate::query::select::mul_prob;
use crate::query::weights::Weights;
use crate::simd::dispatch;

impl LightBvhRef<'_> {
    /// One light, by a first choice between the tree and infinite lights.
    ///
    /// `first` gets the [`irradiance`](Self::irradiance) of the tree at `ctx`. It continues into
    /// the tree with the probability of that choice and the unused part of its `u`, or breaks with
    /// another light. The result has the bits of [`sample_after`](Self::sample_after), but the root
    /// is evaluated only once.
    #[inline]
    #[must_use]
    pub fn sample_with_infinite(
        &self,
        ctx: &LightSampleContext,
        first: impl FnOnce(f64) -> ControlFlow<Option<SampledLight>, (f32, f64)>,
    ) -> Option<SampledLight> {
        dispatch(QueryFor(ctx, SampleWithInfinite { tree: self, first }))
    }
}

/// [`LightBvhRef::sample_with_infinite`].
struct SampleWithInfinite<'a, 'b, F> {
    tree: &'b LightBvhRef<'a>,
    first: F,
}

impl<F: FnOnce(f64) -> ControlFlow<Option<SampledLight>, (f32, f64)>> Query
    for SampleWithInfinite<'_, '_, F>
{
    type Output = Option<SampledLight>;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        let Some(root) = self.tree.nodes().first() else {
            return (self.first)(0.0).break_value()?;
        };
        let weights = Weights::new(root, receiver);
        match (self.first)(weights.irradiance(root)) {
            ControlFlow::Break(other) => other,
            ControlFlow::Continue((pmf, u)) => {
                let choice = weights.choose(u)?;
                let pmf = mul_prob(pmf, choice.probability);
                self.tree
                    .descend_from(receiver, 0, choice.child, pmf, choice.u)
            }
        }
    }
}
