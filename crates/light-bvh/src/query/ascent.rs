use light_bounds::LightId;
use light_math::float::positive_product;

use crate::importance::receiver::Receiver;
use crate::node::wide_node::{MAX_DEPTH, NOWHERE, WIDTH};
use crate::query::bvh_ref::LightBvhRef;
use crate::query::into_receiver::Query;

/// Probabilities that are known before the ascent.
///
/// Implementations are `#[inline(always)]`, as closures cannot be: the caller chooses the vectors.
pub(crate) trait KnownPmfs {
    /// The probability of a child of a node, with all choices that lead there.
    fn pmf(&self, node: usize, child: usize) -> Option<f32>;
}

/// No probability is known: the ascent ends at the root.
struct NothingKnown;

impl KnownPmfs for NothingKnown {
    #[inline(always)]
    fn pmf(&self, _: usize, _: usize) -> Option<f32> {
        None
    }
}

/// [`LightBvhRef::pmf`].
pub(crate) struct Ascent<'a, 'b> {
    pub(crate) tree: &'b LightBvhRef<'a>,
    pub(crate) light: LightId,
}

impl Query for Ascent<'_, '_> {
    type Output = f32;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        self.tree.ascend(receiver, self.light, &NothingKnown)
    }
}

impl LightBvhRef<'_> {
    /// The probability of `light`. The way up ends at the root, or at the first child whose
    /// probability is `known`.
    #[inline(always)]
    pub(crate) fn ascend<R: Receiver>(
        &self,
        receiver: &R,
        light: LightId,
        known: &impl KnownPmfs,
    ) -> f32 {
        let mut shares = [0.0; MAX_DEPTH];
        let mut slot = self.slot(light);
        if slot == NOWHERE {
            return 0.0;
        }
        let (mut pmf, mut levels) = (1.0, 0);
        // Up along the parents: the path is known before any weight is, so the loads of its nodes
        // overlap.
        while slot != NOWHERE {
            let (index, child) = (slot as usize / WIDTH, slot as usize % WIDTH);
            if let Some(known) = known.pmf(index, child) {
                pmf = known;
                break;
            }
            let (Some(node), Some(share)) = (self.nodes().get(index), shares.get_mut(levels))
            else {
                return 0.0;
            };
            let weights = self.weights(index, node, receiver);
            *share = weights.probability(child);
            levels += 1;
            slot = node.parent;
        }
        // Multiplied from the root down, as a sample does it.
        shares[..levels]
            .iter()
            .rev()
            .fold(pmf, |pmf, &s| positive_product(pmf, s))
    }
}
