use light_bounds::{CompactLightBounds, LightId, LightSampleContext};

use super::descend::{above_zero, child_index, power_weight};
use super::{BitTrail, Link, ReferenceLightBvhRef};

impl ReferenceLightBvhRef<'_> {
    /// Probability that [`sample`](Self::sample) at `ctx` returns `light`, to the same bits; 0 for
    /// a light that is not in the tree.
    #[must_use]
    pub fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.follow(light, |bounds| bounds.importance(self.bounds, ctx))
    }

    /// Probability that [`sample_emitter`](Self::sample_emitter) returns `light`, to the same bits.
    #[must_use]
    pub fn pmf_emitter(&self, light: LightId) -> f32 {
        self.follow(light, power_weight)
    }

    fn follow(&self, light: LightId, weight: impl Fn(&CompactLightBounds) -> f32) -> f32 {
        let trail = self.trail(light);
        if trail == BitTrail::NONE {
            return 0.0;
        }
        if trail == BitTrail::ROOT {
            return f32::from(u8::from(weight(self.nodes[0].bounds()) > 0.0));
        }
        let mut index = 0;
        let mut pmf = 1.0;
        for side in trail.sides() {
            let Link::Interior { second_child } = self.nodes[index].link() else {
                break;
            };
            let fork = self.fork(index, second_child as usize, &weight);
            let probability = fork.probability(side);
            if probability == 0.0 {
                return 0.0;
            }
            pmf *= probability;
            index = child_index(side, index, second_child as usize);
        }
        above_zero(pmf)
    }

    /// The way to `light`; [`BitTrail::NONE`] if it is not in the tree.
    #[inline]
    #[must_use]
    pub fn trail(&self, light: LightId) -> BitTrail {
        self.trails
            .get(light.index())
            .copied()
            .unwrap_or(BitTrail::NONE)
    }
}
