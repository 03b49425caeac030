use light_bounds::{InfiniteBounds, LightExtent, LightId, LightSampleContext, SampledLight};
use light_bvh::{LightBvh, LightBvhError};

use crate::LightSampler;
use crate::sky::{Sky, irradiance};

/// The default: chooses about in proportion to the irradiance that each light would give without occlusion.
///
/// Reads `ctx.ns`. Lights at infinity take part with their own estimated irradiance beside that of the tree, so that a strong sun and
/// ten thousand lamps share sensibly by day and by night. About 32 bytes a light; a query takes a node of eight children a level,
/// and looks at every light at infinity.
#[derive(Clone, Debug, Default)]
pub struct BvhLightSampler {
    tree: LightBvh,
    sky: Sky,
}

impl BvhLightSampler {
    /// A sampler of `lights`; the index of a light is its id.
    ///
    /// # Errors
    /// As for [`LightBvh::build`].
    pub fn new(lights: &[LightExtent]) -> Result<Self, LightBvhError> {
        Ok(Self {
            tree: LightBvh::build(lights)?,
            sky: Sky::new(lights),
        })
    }

    /// The tree of the lights that are somewhere.
    #[must_use]
    pub const fn tree(&self) -> &LightBvh {
        &self.tree
    }

    /// The choice between the tree and the lights at infinity, which share `u` by what they are worth.
    fn choose(&self, u: f64, in_tree: f64, worth: impl Fn(&InfiniteBounds) -> f64) -> FirstChoice {
        let total = in_tree + self.sky.total(&worth);
        let target = u * total;
        if target < in_tree {
            return FirstChoice::Tree {
                pmf: share(in_tree, total),
                u: (target / in_tree).clamp(0.0, SampledLight::MAX_U),
            };
        }
        let pmf = |weight| share(weight, total);
        FirstChoice::Sky(self.sky.choose(target - in_tree, &worth, pmf))
    }

    /// The probability of the first choice that leads to `light`.
    fn first_pmf(
        &self,
        light: LightId,
        in_tree: f64,
        worth: impl Fn(&InfiniteBounds) -> f64,
    ) -> FirstPmf {
        let total = in_tree + self.sky.total(&worth);
        match self.sky.get(light) {
            Some(bounds) => FirstPmf::Sky(share(worth(bounds), total)),
            None => FirstPmf::Tree(share(in_tree, total)),
        }
    }
}

enum FirstChoice {
    Tree { pmf: f32, u: f64 },
    Sky(Option<SampledLight>),
}

enum FirstPmf {
    Tree(f32),
    Sky(f32),
}

impl LightSampler for BvhLightSampler {
    #[inline]
    fn sample(&self, ctx: &LightSampleContext, u: f64) -> Option<SampledLight> {
        if self.sky.is_empty() {
            return self.tree.sample(ctx, u);
        }
        let worth = |bounds: &InfiniteBounds| irradiance(bounds, ctx);
        match self.choose(u, self.tree.irradiance(ctx), worth) {
            FirstChoice::Tree { pmf, u } => self.tree.view().sample_after(ctx, pmf, u),
            FirstChoice::Sky(light) => light,
        }
    }

    #[inline]
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        if self.sky.is_empty() {
            return self.tree.pmf(ctx, light);
        }
        let worth = |bounds: &InfiniteBounds| irradiance(bounds, ctx);
        match self.first_pmf(light, self.tree.irradiance(ctx), worth) {
            FirstPmf::Tree(pmf) => self.tree.view().pmf_after(ctx, pmf, light),
            FirstPmf::Sky(pmf) => pmf,
        }
    }

    fn sample_emitter(&self, u: f64) -> Option<SampledLight> {
        match self.choose(u, self.tree.power(), fluence) {
            FirstChoice::Tree { pmf, u } => self.tree.view().sample_emitter_after(pmf, u),
            FirstChoice::Sky(light) => light,
        }
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        match self.first_pmf(light, self.tree.power(), fluence) {
            FirstPmf::Tree(pmf) => self.tree.view().pmf_emitter_after(pmf, light),
            FirstPmf::Sky(pmf) => pmf,
        }
    }
}

fn fluence(bounds: &InfiniteBounds) -> f64 {
    f64::from(bounds.fluence)
}

/// `weight / total`: 0 only if the weight is.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding is what is meant; the floor keeps it above 0"
)]
fn share(weight: f64, total: f64) -> f32 {
    if weight > 0.0 {
        ((weight / total) as f32).max(f32::MIN_POSITIVE)
    } else {
        0.0
    }
}
