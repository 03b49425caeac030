use light_bounds::{CompactLightBounds, LightSampleContext, SampledLight};
use light_math::fraction;

use super::fork::Fork;
use super::{Link, ReferenceLightBvhRef, ReferenceNode, Side};

impl ReferenceLightBvhRef<'_> {
    /// One light that may light `ctx`, chosen in proportion to importance at every fork, for `u`, a
    /// fraction of 2^64 of which the upper 53 bits count.
    ///
    /// `None` where the walk ends above lights none of which can contribute: bounds tighten on the
    /// way down.
    ///
    /// # Source
    /// `[PBRT4]`, section 12.6.3.
    #[must_use]
    pub fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.descend(u, |bounds| bounds.importance(self.bounds, ctx))
    }

    /// One light in proportion to its power; `None` if the tree is empty.
    #[must_use]
    pub fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.descend(u, power_weight)
    }

    fn descend(&self, u: u64, weight: impl Fn(&CompactLightBounds) -> f32) -> Option<SampledLight> {
        let mut index = 0;
        let mut node = self.nodes.first()?;
        // Any other node was weighed before the walk went there.
        if matches!(node.link(), Link::Leaf(_)) && !(weight(node.bounds()) > 0.0) {
            return None;
        }
        let mut pmf = 1.0;
        let mut u = fraction::to_f64(u);
        loop {
            match node.link() {
                Link::Leaf(light) => {
                    let (pmf, u) = (above_zero(pmf), fraction::from_f64(u));
                    return Some(SampledLight { light, pmf, u });
                }
                Link::Interior { second_child } => {
                    let fork = self.fork(index, second_child as usize, &weight);
                    let (side, rest) = fork.choose(u)?;
                    pmf *= fork.probability(side);
                    u = rest;
                    index = child_index(side, index, second_child as usize);
                    node = &self.nodes[index];
                }
            }
        }
    }

    /// The choice between the child behind node `parent` and the one at `second`.
    #[inline]
    pub(super) fn fork(
        &self,
        parent: usize,
        second: usize,
        weight: impl Fn(&CompactLightBounds) -> f32,
    ) -> Fork {
        let of = |node: &ReferenceNode| weight(node.bounds());
        Fork::new(of(&self.nodes[parent + 1]), of(&self.nodes[second]))
    }
}

/// Where the walk goes on.
#[inline]
pub(super) const fn child_index(side: Side, parent: usize, second: usize) -> usize {
    match side {
        Side::First => parent + 1,
        Side::Second => second,
    }
}

/// A weight in proportion to power, so small that a sum of two is finite, and not zero.
#[inline]
pub(super) fn power_weight(bounds: &CompactLightBounds) -> f32 {
    (0.25 * bounds.phi()).max(f32::MIN_POSITIVE)
}

/// The product of many probabilities above zero, which may be too small for a float.
#[inline]
pub(super) fn above_zero(pmf: f32) -> f32 {
    pmf.max(f32::MIN_POSITIVE)
}
