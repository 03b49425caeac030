use light_bounds::SampledLight;
use light_math::float::positive_product;

use crate::importance::receiver::Receiver;
use crate::node::wide_node::MAX_DEPTH;
use crate::query::bvh_ref::{Child, LightBvhRef};
use crate::query::into_receiver::Query;
use crate::query::select::Choice;

/// How many levels below the start of a descent the caches hold: they are not prefetched.
const CACHED_LEVELS: usize = 2;

/// [`LightBvhRef::sample`].
pub(crate) struct Descent<'a, 'b> {
    pub(crate) tree: &'b LightBvhRef<'a>,
    pub(crate) u: u64,
}

impl Query for Descent<'_, '_> {
    type Output = Option<SampledLight>;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        self.tree.descend(receiver, 0, 1.0, self.u)
    }
}

impl LightBvhRef<'_> {
    /// From `node`, which was reached with probability `pmf`, down to a light.
    #[inline(always)]
    fn descend<R: Receiver>(
        &self,
        receiver: &R,
        node: usize,
        pmf: f32,
        u: u64,
    ) -> Option<SampledLight> {
        let (mut index, mut pmf, mut u) = (node, pmf, u);
        for level in 0..MAX_DEPTH {
            let node = self.nodes().get(index)?;
            if level >= CACHED_LEVELS {
                self.prefetch_below(node);
            }
            let weights = self.weights(index, node, receiver);
            let choice = weights.choose(u)?;
            pmf = positive_product(pmf, choice.probability);
            u = choice.u;
            match self.child(node, choice.child)? {
                Child::Light(light) => return Some(SampledLight { light, pmf, u }),
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
        let pmf = positive_product(pmf, choice.probability);
        let u = choice.u;
        match self.child(self.nodes().get(node as usize)?, choice.child)? {
            Child::Light(light) => Some(SampledLight { light, pmf, u }),
            Child::Node(child) => self.descend(receiver, child, pmf, u),
        }
    }
}
