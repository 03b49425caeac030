use light_bounds::{LightGroups, LightId, LightSampleContext};
use light_math::float::positive_product;

use crate::importance::context_receiver::ContextReceiver;
use crate::instances::instanced_bvh::InstancedLightBvh;
use crate::instances::placed_light::{PlacedLight, SampledPlacedLight};
use crate::instances::placed_receiver::PlacedContext;
use crate::query::bvh_at::LightBvhAt;
use crate::query::bvh_ref::LightBvhRef;

/// A tree of trees as one context sees it: the root is evaluated once for all queries.
#[derive(Clone, Copy, Debug)]
pub struct InstancedLightBvhAt<'a> {
    tree: &'a InstancedLightBvh,
    groups: LightGroups,
    receiver: ContextReceiver,
    top: LightBvhAt<'a>,
}

impl InstancedLightBvh {
    /// One light that may light `ctx`; `None` if this choice contributes nothing.
    #[inline]
    #[must_use]
    pub fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledPlacedLight> {
        self.at(ctx).sample(u)
    }

    /// Probability that [`sample`](Self::sample) at `ctx` returns `light`, to the bit.
    #[inline]
    #[must_use]
    pub fn pmf(&self, ctx: &LightSampleContext, light: PlacedLight) -> f32 {
        self.at(ctx).pmf(light)
    }

    /// The tree as `ctx` sees it: the root is evaluated once for all queries.
    #[inline]
    #[must_use]
    pub fn at(&self, ctx: &LightSampleContext) -> InstancedLightBvhAt<'_> {
        InstancedLightBvhAt {
            tree: self,
            groups: ctx.groups,
            receiver: ContextReceiver::from(ctx),
            top: self.top().view().at(ctx),
        }
    }
}

impl<'a> InstancedLightBvhAt<'a> {
    /// About the irradiance, or in a medium the fluence, by all lights of a tree of power 1; 0 only
    /// if none of them can contribute.
    #[inline]
    #[must_use]
    pub fn irradiance(&self) -> f32 {
        self.top.irradiance()
    }

    /// One light that may light the context; `None` if this choice contributes nothing.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: u64) -> Option<SampledPlacedLight> {
        let placed = self.top.sample(u)?;
        let (tree, receiver) = self.in_prototype(placed.light.0)?;
        let chosen = tree.sample(receiver, placed.u)?;
        Some(SampledPlacedLight::of(&placed, &chosen))
    }

    /// Probability that [`sample`](Self::sample) returns `light`, to the bit.
    #[inline]
    #[must_use]
    pub fn pmf(&self, light: PlacedLight) -> f32 {
        let Some((tree, receiver)) = self.in_prototype(light.placement) else {
            return 0.0;
        };
        let placed = self.top.pmf(LightId(light.placement));
        positive_product(placed, tree.pmf(receiver, light.light))
    }

    /// The tree of a placement's prototype, and the receiver in its frame.
    #[inline]
    fn in_prototype(&self, placement: u32) -> Option<(LightBvhRef<'a>, PlacedContext)> {
        let (frame, prototype) = self.tree.placed(placement)?;
        let receiver = PlacedContext {
            receiver: frame.receiver(&self.receiver, prototype),
            groups: self.groups,
        };
        Some((prototype.tree().view(), receiver))
    }
}
