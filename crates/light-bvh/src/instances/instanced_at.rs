use light_bounds::{LightGroups, LightId, LightSampleContext};
use light_math::float::positive_product;

use crate::importance::context_receiver::ContextReceiver;
use crate::importance::receiver::NoReceiver;
use crate::instances::instanced_bvh::InstancedLightBvh;
use crate::instances::placed_light::{PlacedLight, SampledPlacedLight};
use crate::instances::placed_part::PlacedPart;
use crate::query::bvh_at::LightBvhAt;
use crate::query::descent::{AfterLevels, ChosenEntry, Descent};
use crate::query::into_receiver::InGroups;

/// A tree of trees as one context sees it: the root is evaluated once for all queries.
///
/// The probabilities have the bits of [`InstancedLightBvh::sample`] and
/// [`InstancedLightBvh::pmf`].
#[derive(Clone, Copy, Debug)]
pub struct InstancedLightBvhAt<'a> {
    tree: &'a InstancedLightBvh,
    receiver: InGroups<ContextReceiver>,
    top: LightBvhAt<'a>,
}

impl InstancedLightBvh {
    /// One light that may light `ctx`; `None` if this choice contributes nothing.
    #[must_use]
    pub fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledPlacedLight> {
        let InGroups { receiver, groups } = &ctx.into();
        let top = self.top().view();
        let placed = top.sample_entry(receiver, *groups, u, self.frames())?;
        self.sample_in(&placed, receiver, *groups)
    }

    /// Probability that [`sample`](Self::sample) at `ctx` returns `light`, to the bit.
    #[must_use]
    pub fn pmf(&self, ctx: &LightSampleContext, light: PlacedLight) -> f32 {
        let InGroups { receiver, groups } = &ctx.into();
        let top = self.top().view();
        if let Some(leaf) = self.openings().leaf(light) {
            return top.pmf_for(receiver, *groups, leaf);
        }
        let Some((leaf, part)) = self.part(light, receiver) else {
            return 0.0;
        };
        let placed = top.pmf_for(receiver, *groups, leaf);
        positive_product(placed, part.pmf(light.light, receiver, *groups))
    }

    /// The tree as `ctx` sees it: the root is evaluated once for all queries.
    #[must_use]
    pub fn at(&self, ctx: &LightSampleContext) -> InstancedLightBvhAt<'_> {
        let receiver = ctx.into();
        InstancedLightBvhAt {
            tree: self,
            receiver,
            top: self.top().view().at(&receiver),
        }
    }

    /// One light to emit from, about in proportion to its peak intensity; `None` if the tree is
    /// empty.
    #[must_use]
    pub fn sample_emitter(&self, u: u64) -> Option<SampledPlacedLight> {
        let placed = self.top().view().sample_emitter(u)?;
        if let Some(light) = self.openings().light(&placed) {
            return Some(light);
        }
        let (placement, part) = self.ids().part(placed.light.0);
        let prototype = self.prototype(placement)?;
        let root = prototype.parts().get(part)?.root();
        let chosen = prototype.view().sample_below(&NoReceiver, root, placed.u)?;
        Some(SampledPlacedLight::of(placement, placed.pmf, &chosen))
    }

    /// Probability that [`sample_emitter`](Self::sample_emitter) returns `light`, to the bit.
    #[must_use]
    pub fn pmf_emitter(&self, light: PlacedLight) -> f32 {
        if let Some(leaf) = self.openings().leaf(light) {
            return self.top().view().pmf_emitter(leaf);
        }
        let Some((leaf, _, prototype)) = self.leaf(light) else {
            return 0.0;
        };
        let placed = self.top().view().pmf_emitter(leaf);
        positive_product(placed, prototype.view().pmf_emitter(light.light))
    }

    /// The leaf that a light is in, and the part of a placement that this is; `None` if the light has
    /// no place.
    #[inline(always)]
    fn part(
        &self,
        light: PlacedLight,
        receiver: &ContextReceiver,
    ) -> Option<(LightId, PlacedPart<'_>)> {
        let (leaf, frame, prototype) = self.leaf(light)?;
        let top = self.top().view();
        let part = PlacedPart {
            frame,
            prototype,
            is_told_apart: top.tells_apart(receiver, top.slot(leaf) as usize),
        };
        Some((leaf, part))
    }

    /// The light of an opened placement, or one light of a placement, that was chosen.
    #[inline(always)]
    fn sample_in(
        &self,
        placed: &ChosenEntry,
        receiver: &ContextReceiver,
        groups: LightGroups,
    ) -> Option<SampledPlacedLight> {
        let top = self.top().view();
        if !self.openings().is_empty() {
            if let Some(light) = self.openings().light(&top.light_of(placed)?) {
                return Some(light);
            }
        }
        let leaf = top.light(placed.entry)?;
        let (placement, part) = self.ids().part(leaf.0);
        let frame = self.frames().of_entry(placed.entry, leaf, self.ids())?;
        let prototype = self.prototypes().get(frame.prototype())?;
        let query = Descent {
            tree: &prototype.view().wanting(groups),
            root: prototype.parts().get(part)?.root(),
            u: placed.u,
            prefetch: AfterLevels::OF_PROTOTYPE,
        };
        let part = PlacedPart {
            frame,
            prototype,
            is_told_apart: top.tells_apart(receiver, placed.slot),
        };
        let chosen = part.answer(receiver, query)?;
        Some(SampledPlacedLight::of(placement, placed.pmf, &chosen))
    }
}

impl InstancedLightBvhAt<'_> {
    /// About the irradiance, or in a medium the fluence, by all lights of a tree of power 1; 0 only
    /// if none of them can contribute.
    #[inline]
    #[must_use]
    pub fn irradiance(&self) -> f32 {
        self.top.irradiance()
    }

    /// One light that may light the context; `None` if this choice contributes nothing.
    #[must_use]
    pub fn sample(&self, u: u64) -> Option<SampledPlacedLight> {
        let InGroups { receiver, groups } = &self.receiver;
        let placed = self.top.sample_entry(u, self.tree.frames())?;
        self.tree.sample_in(&placed, receiver, *groups)
    }

    /// Probability that [`sample`](Self::sample) returns `light`, to the bit.
    #[must_use]
    pub fn pmf(&self, light: PlacedLight) -> f32 {
        let InGroups { receiver, groups } = &self.receiver;
        if let Some(leaf) = self.tree.openings().leaf(light) {
            return self.top.pmf(leaf);
        }
        let Some((leaf, part)) = self.tree.part(light, receiver) else {
            return 0.0;
        };
        positive_product(self.top.pmf(leaf), part.pmf(light.light, receiver, *groups))
    }
}
