use light_bounds::{LightId, LightSampleContext};
use light_math::float::positive_product;

use crate::importance::context_receiver::ContextReceiver;
use crate::instances::instanced_bvh::InstancedLightBvh;
use crate::instances::placed_light::{PlacedLight, SampledPlacedLight};
use crate::instances::placed_receiver::PlacedReceiver;
use crate::query::bvh_at::LightBvhAt;
use crate::query::bvh_ref::LightBvhRef;
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
        let placed = self.top().view().sample_for(receiver, *groups, u)?;
        let (tree, inside) = self.in_prototype(placed.light.0, receiver)?;
        let chosen = tree.sample_for(&inside, *groups, placed.u)?;
        Some(SampledPlacedLight::of(&placed, &chosen))
    }

    /// Probability that [`sample`](Self::sample) at `ctx` returns `light`, to the bit.
    #[must_use]
    pub fn pmf(&self, ctx: &LightSampleContext, light: PlacedLight) -> f32 {
        let InGroups { receiver, groups } = &ctx.into();
        let Some((tree, inside)) = self.in_prototype(light.placement, receiver) else {
            return 0.0;
        };
        let top = self.top().view();
        let placed = top.pmf_for(receiver, *groups, LightId(light.placement));
        positive_product(placed, tree.pmf_for(&inside, *groups, light.light))
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

    /// The tree of a placement's prototype, and the receiver in its frame.
    #[inline]
    fn in_prototype(
        &self,
        placement: u32,
        receiver: &ContextReceiver,
    ) -> Option<(LightBvhRef<'_>, PlacedReceiver)> {
        let (frame, prototype) = self.placed(placement)?;
        let inside = frame.receiver(receiver, prototype);
        Some((prototype.tree().view(), inside))
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
        let placed = self.top.sample(u)?;
        let (tree, inside) = self.tree.in_prototype(placed.light.0, receiver)?;
        let chosen = tree.sample_for(&inside, *groups, placed.u)?;
        Some(SampledPlacedLight::of(&placed, &chosen))
    }

    /// Probability that [`sample`](Self::sample) returns `light`, to the bit.
    #[must_use]
    pub fn pmf(&self, light: PlacedLight) -> f32 {
        let InGroups { receiver, groups } = &self.receiver;
        let Some((tree, inside)) = self.tree.in_prototype(light.placement, receiver) else {
            return 0.0;
        };
        let placed = self.top.pmf(LightId(light.placement));
        positive_product(placed, tree.pmf_for(&inside, *groups, light.light))
    }
}
