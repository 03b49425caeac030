//! How a [`LightCut`] is sampled.

use light_bounds::{LightId, SampledLight};
use light_math::discrete::PART;
use light_math::float::positive_product;
use light_math::fraction::divide;

use crate::cut::light_cut::{CutNodes, LightCut};
use crate::importance::receiver::Receiver;
use crate::query::ascent::KnownPmfs;
use crate::query::into_receiver::{KeptReceiver, Query, QueryFor};
use crate::simd::dispatch;

impl<R: KeptReceiver> LightCut<'_, R> {
    /// One light that may light the receiver; `None` if no light in the tree can. For `k` lights,
    /// call it with `u` of [each of `k` strata](light_math::fraction::stratum).
    #[must_use]
    pub fn sample(&self, u: u64) -> Option<SampledLight> {
        dispatch(QueryFor(&self.receiver, Sample { cut: self, u }))
    }

    /// Probability that [`sample`](Self::sample) returns `light`, to the bit.
    #[must_use]
    pub fn pmf(&self, light: LightId) -> f32 {
        dispatch(QueryFor(&self.receiver, Probability { cut: self, light }))
    }
}

/// [`LightCut::sample`].
struct Sample<'a, 'b, K> {
    cut: &'b LightCut<'a, K>,
    u: u64,
}

impl<K> Query for Sample<'_, '_, K> {
    type Output = Option<SampledLight>;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        let LightCut { tree, grown, .. } = self.cut;
        if !(grown.sum > 0.0) {
            return None;
        }
        let place = (self.u >> 48) as u32;
        // All are compared, for a search that stops could not be foretold.
        let index: u32 = grown.ends.iter().map(|&end| u32::from(end <= place)).sum();
        let index = index as usize;
        let node = *grown.nodes.get(index)?;
        let (start, parts) = grown.parts(index);
        let u = divide(place - start, self.u << 16, parts);
        let choice = grown.weights(index).choose(u)?;
        tree.descend_from(receiver, node, parts as f32 * PART, &choice)
    }
}

/// [`LightCut::pmf`].
struct Probability<'a, 'b, K> {
    cut: &'b LightCut<'a, K>,
    light: LightId,
}

impl<K> Query for Probability<'_, '_, K> {
    type Output = f32;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> f32 {
        let LightCut { tree, grown, .. } = self.cut;
        tree.ascend(receiver, self.light, grown)
    }
}

impl KnownPmfs for CutNodes {
    #[inline(always)]
    fn pmf(&self, node: usize, child: usize) -> Option<f32> {
        let nodes = &self.nodes[..self.count];
        let index = nodes.iter().position(|&n| n as usize == node)?;
        let (_, parts) = self.parts(index);
        let within = self.weights(index).probability(child);
        Some(positive_product(parts as f32 * PART, within))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::light_cut::MAX_NODES;
    use light_math::discrete;

    /// Nodes of a cut of the given sums of weights.
    fn cut(totals: &[f32]) -> CutNodes {
        let mut cut = CutNodes::none();
        cut.totals[..totals.len()].copy_from_slice(totals);
        cut.sum = totals.iter().sum();
        cut.count = totals.len();
        cut.share_parts();
        cut
    }

    #[test]
    fn nodes_share_the_parts() {
        for totals in [
            &[1.0, 0.0, 3.0][..],
            &[0.0, 1e-30, 0.0, 1e30, 1.0],
            &[1.0; MAX_NODES],
            &[0.0, 2.0],
        ] {
            let cut = cut(totals);
            let mut from = 0;
            for (index, &total) in totals.iter().enumerate() {
                let (start, parts) = cut.parts(index);
                assert_eq!(start, from, "{index} of {totals:?}");
                assert_eq!(parts > 0, total > 0.0, "{index} of {totals:?}: {parts}");
                let pmf = f64::from(parts as f32 * PART);
                let near = f64::from(discrete::pmf(totals, index));
                assert!((pmf - near).abs() < 25.0 / 65536.0, "{index}: {pmf} {near}");
                from = start + parts;
            }
            assert_eq!(from, discrete::PARTS, "all of {totals:?}");
        }
    }
}
