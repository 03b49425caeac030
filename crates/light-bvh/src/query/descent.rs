use light_bounds::SampledLight;

use crate::importance::receiver::Receiver;
use crate::node::wide_node::MAX_DEPTH;
use crate::query::bvh_ref::{Child, LightBvhRef};
use crate::query::into_receiver::Query;
use crate::query::select::mul_prob;
use crate::query::weights::Weights;

/// How many levels below the start of a descent the caches hold: they are not prefetched.
const CACHED_LEVELS: usize = 2;

/// [`LightBvhRef::sample_after`].
pub(crate) struct Descent<'a, 'b> {
    pub(crate) tree: &'b LightBvhRef<'a>,
    pub(crate) pmf: f32,
    pub(crate) u: f64,
}

impl Query for Descent<'_, '_> {
    type Output = Option<SampledLight>;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        self.tree.descend(receiver, 0, self.pmf, self.u)
    }
}

impl LightBvhRef<'_> {
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
            let node = self.nodes().get(index)?;
            if level >= CACHED_LEVELS {
                self.prefetch_below(node);
            }
            let choice = Weights::new(node, receiver).choose(u)?;
            pmf = mul_prob(pmf, choice.probability);
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
        match self.child(self.nodes().get(node as usize)?, child)? {
            Child::Light(light) => Some(SampledLight { light, pmf, u }),
            Child::Node(child) => self.descend(receiver, child, pmf, u),
        }
    }
}
