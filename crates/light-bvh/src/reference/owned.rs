use alloc::vec::Vec;

use light_bounds::light_math::Aabb;
use light_bounds::{LightExtent, LightId, LightSampleContext, SampledLight};

use super::builder;
use super::view::visit_leaves;
use super::{BitTrail, ReferenceLightBvhRef, ReferenceNode, ReferenceStats};
use crate::LightBvhError;

/// The tree with its memory: 64 bytes of nodes and a trail of 4 bytes a light.
#[derive(Clone, Debug)]
#[doc(alias = "light tree")]
pub struct ReferenceLightBvh {
    nodes: Vec<ReferenceNode>,
    trails: Vec<BitTrail>,
    bounds: Aabb,
}

impl ReferenceLightBvh {
    /// The tree of the lights in `lights` that are somewhere and have power; the index of a light
    /// is its id.
    ///
    /// Takes time in proportion to `n log n`. The same lights give the same tree, whatever the
    /// number of threads.
    ///
    /// # Errors
    /// [`LightBvhError`] names the first light whose bounds are not valid; or there are more than
    /// 2^30 lights.
    pub fn build(lights: &[LightExtent]) -> Result<Self, LightBvhError> {
        let (nodes, bounds) = builder::build(lights)?;
        let mut trails = alloc::vec![BitTrail::NONE; lights.len()];
        let walk = visit_leaves(&nodes, |light, trail| {
            trails[light.index()] = trail;
            true
        });
        debug_assert!(walk.is_ok(), "the builder makes a tree");
        Ok(Self {
            nodes,
            trails,
            bounds,
        })
    }

    /// The tree as sampling sees it, for instance to copy it to another device.
    #[inline]
    #[must_use]
    pub fn view(&self) -> ReferenceLightBvhRef<'_> {
        ReferenceLightBvhRef {
            nodes: &self.nodes,
            trails: &self.trails,
            bounds: &self.bounds,
        }
    }

    /// See [`ReferenceLightBvhRef::sample`].
    #[inline]
    #[must_use]
    pub fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.view().sample(ctx, u)
    }

    /// See [`ReferenceLightBvhRef::pmf`].
    #[inline]
    #[must_use]
    pub fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.view().pmf(ctx, light)
    }

    /// See [`ReferenceLightBvhRef::sample_emitter`].
    #[inline]
    #[must_use]
    pub fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.view().sample_emitter(u)
    }

    /// See [`ReferenceLightBvhRef::pmf_emitter`].
    #[inline]
    #[must_use]
    pub fn pmf_emitter(&self, light: LightId) -> f32 {
        self.view().pmf_emitter(light)
    }

    /// Whether no light is in the tree.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// See [`ReferenceLightBvhRef::stats`].
    #[must_use]
    pub fn stats(&self) -> ReferenceStats {
        self.view().stats()
    }
}
