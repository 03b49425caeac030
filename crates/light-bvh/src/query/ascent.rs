use light_bounds::LightId;

use crate::importance::receiver::Receiver;
use crate::node::wide_node::{MAX_DEPTH, NOWHERE, WIDTH};
use crate::query::bvh_ref::LightBvhRef;
use crate::query::into_receiver::Query;
use crate::query::select::mul_prob;
use crate::query::weights::Weights;

/// [`LightBvhRef::pmf_after`].
pub(crate) struct Ascent<'a, 'b> {
    pub(crate) tree: &'b LightBvhRef<'a>,
    pub(crate) pmf: f32,
    pub(crate) light: LightId,
}

impl Query for Ascent<'_, '_> {
    type Output = f32;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        let nothing = |_, _| None;
        self.tree.ascend(receiver, self.pmf, self.light, nothing)
    }
}

impl LightBvhRef<'_> {
    /// The probability of `light`, where the root has the probability `pmf`. The way up ends at the
    /// first child (node, slot) whose probability `known` returns.
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
        // Up along the parents: which nodes to visit does not depend on what they weigh, so their
        // latencies overlap.
        while slot != NOWHERE {
            let (index, child) = (slot as usize / WIDTH, slot as usize % WIDTH);
            if let Some(known) = known(index, child) {
                pmf = known;
                break;
            }
            let (Some(node), Some(share)) = (self.nodes().get(index), shares.get_mut(levels))
            else {
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
            .fold(pmf, |pmf, &s| mul_prob(pmf, s))
    }
}
