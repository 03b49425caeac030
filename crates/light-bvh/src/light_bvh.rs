use alloc::vec;
use alloc::vec::Vec;

use light_bounds::{LightExtent, LightId, LightSampleContext, SampledLight};

use crate::LightBvhError;
use crate::build::builder::build;
use crate::build::options::LightBvhOptions;
use crate::build::refit::fill;
use crate::build::scan::Scan;
use crate::node::wide_node::{NOWHERE, WIDTH, WideNode};
use crate::parallel::join;
use crate::query::bvh_ref::LightBvhRef;

/// The default light hierarchy: chooses one of many lights about in proportion to its irradiance.
///
/// Sixteen children a node, each described by moments of its lights: expected irradiance instead of a bound of it, and zero only where
/// no light can contribute. About 32 bytes a light.
#[derive(Clone, Debug, Default)]
pub struct LightBvh {
    pub(crate) nodes: Vec<WideNode>,
    pub(crate) order: Vec<u32>,
    pub(crate) slots: Vec<u32>,
    pub(crate) power: f64,
}

impl LightBvh {
    /// The hierarchy of the bounded lights of `lights`, in which the index of an entry is its [`LightId`].
    ///
    /// Infinite lights, and lights without power, are not in the tree and have pmf 0.
    ///
    /// # Errors
    /// The first light with invalid bounds or a coordinate beyond ±1e36.
    pub fn build(lights: &[LightExtent]) -> Result<Self, LightBvhError> {
        Self::build_with(lights, &LightBvhOptions::default())
    }

    /// The same, built as `options` say.
    ///
    /// # Errors
    /// As for [`build`](Self::build).
    pub fn build_with(
        lights: &[LightExtent],
        options: &LightBvhOptions,
    ) -> Result<Self, LightBvhError> {
        let scan = Scan::new(lights, 0, options.dark, &|_, _| Ok(()))?;
        let (skeleton, order) = build(lights, &scan, options);
        let mut nodes = skeleton.nodes();
        let ((), slots) = join(
            lights.len(),
            || fill(&mut nodes, &order, lights, scan.power),
            || skeleton.slots(&order, lights.len()),
        );
        Ok(Self {
            nodes,
            order,
            slots,
            power: scan.power,
        })
    }

    /// What queries need, borrowed.
    #[inline]
    #[must_use]
    pub fn view(&self) -> LightBvhRef<'_> {
        LightBvhRef::new(&self.nodes, &self.order, &self.slots)
    }

    /// One light that may light `ctx`; `None` if no light in the tree can.
    #[inline]
    #[must_use]
    pub fn sample(&self, ctx: &LightSampleContext, u: f64) -> Option<SampledLight> {
        self.view().sample(ctx, u)
    }

    /// Probability that [`sample`](Self::sample) at `ctx` returns `light`, to the bit.
    #[inline]
    #[must_use]
    pub fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.view().pmf(ctx, light)
    }

    /// About the irradiance at `ctx`, or in a medium the fluence, by all lights of the tree; 0 only if none of them can contribute.
    #[must_use]
    pub fn irradiance(&self, ctx: &LightSampleContext) -> f64 {
        self.view().irradiance(ctx) * self.power
    }

    /// The power of all lights of the tree.
    #[must_use]
    pub const fn power(&self) -> f64 {
        self.power
    }

    /// Bytes that queries may touch.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.order) + size_of_val(&*self.slots)
    }

    /// Levels of nodes, at most [`MAX_DEPTH`](crate::query::bvh_ref::MAX_DEPTH).
    #[must_use]
    pub fn depth(&self) -> usize {
        let mut levels = vec![0; self.nodes.len()];
        let mut deepest = 0;
        for (index, node) in self.nodes.iter().enumerate() {
            // Parents come before their children.
            levels[index] = match node.parent {
                NOWHERE => 1,
                parent => levels[parent as usize / WIDTH] + 1,
            };
            deepest = deepest.max(levels[index]);
        }
        deepest
    }
}
