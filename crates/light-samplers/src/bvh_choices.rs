use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_bvh::visibility::{CellFactors, LightBvhInCellAt};
use light_bvh::{CutDetail, LightBvhAt, LightBvhRef, LightCut};
use light_math::float::positive_product;
use light_math::glam::Vec3;

use crate::infinite_lights::{InfiniteLights, StoredInfiniteLight, irradiance};

/// The default hierarchy and its lights at infinity at one context.
///
/// `T` is the tree: a single choice has another type than several choices, so that a program that
/// makes single ones only has neither the code of a cut nor its size on the stack.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BvhChoices<'a, T> {
    infinite: InfiniteLights<'a>,
    ctx: LightSampleContext,
    /// Estimated irradiance from the lights of the tree; not needed without lights at infinity.
    in_tree: f32,
    tree: T,
}

/// The tree at the context.
pub(crate) trait InTree {
    /// As [`LightBvhAt::sample`].
    fn sample(&self, u: u64) -> Option<SampledLight>;

    /// As [`LightBvhAt::pmf`].
    fn pmf(&self, light: LightId) -> f32;
}

/// No light.
impl Default for BvhChoices<'_, LightCut<'_>> {
    #[inline]
    fn default() -> Self {
        Self {
            infinite: InfiniteLights::default(),
            ctx: LightSampleContext::medium(Vec3::ZERO),
            in_tree: 0.0,
            tree: LightCut::default(),
        }
    }
}

impl<'a> BvhChoices<'a, LightCut<'a>> {
    /// Makes these several choices at `ctx` among the lights of a tree of this power and those at
    /// infinity, by a cut that is made in place: its 2 KB are not moved.
    #[inline]
    pub(crate) fn set(
        &mut self,
        tree: &LightBvhRef<'a>,
        power: f32,
        infinite: InfiniteLights<'a>,
        ctx: &LightSampleContext,
    ) {
        self.infinite = infinite;
        self.ctx = *ctx;
        self.tree.set(tree, &self.ctx, CutDetail::default());
        self.in_tree = positive_product(self.tree.irradiance(), power).min(f32::MAX);
    }
}

impl<'a> BvhChoices<'a, LightBvhInCellAt<'a>> {
    /// For choices from the root with the factors of `cell`.
    #[inline]
    pub(crate) fn in_cell(
        tree: LightBvhRef<'a>,
        power: f32,
        infinite: InfiniteLights<'a>,
        cell: CellFactors<'a>,
        ctx: &LightSampleContext,
    ) -> Self {
        let tree = tree.in_cell(cell).at(ctx);
        Self::of(tree, tree.irradiance(), power, infinite, ctx)
    }
}

impl<'a> BvhChoices<'a, LightBvhAt<'a>> {
    /// For choices from the root at `ctx` among the lights of a tree of this power and those at
    /// infinity.
    #[inline]
    pub(crate) fn from_root(
        tree: LightBvhRef<'a>,
        power: f32,
        infinite: InfiniteLights<'a>,
        ctx: &LightSampleContext,
    ) -> Self {
        let tree = tree.at(ctx);
        Self::of(tree, tree.irradiance(), power, infinite, ctx)
    }
}

impl<'a, T: InTree> BvhChoices<'a, T> {
    #[inline]
    pub(crate) fn of(
        tree: T,
        irradiance: f32,
        power: f32,
        infinite: InfiniteLights<'a>,
        ctx: &LightSampleContext,
    ) -> Self {
        Self {
            infinite,
            ctx: *ctx,
            in_tree: positive_product(irradiance, power).min(f32::MAX),
            tree,
        }
    }

    #[cfg_attr(target_os = "none", inline(never))]
    pub(crate) fn sample(&self, u: u64) -> Option<SampledLight> {
        if self.infinite.is_empty() {
            return self.tree.sample(u);
        }
        let weight = |light: &StoredInfiniteLight| irradiance(light, &self.ctx);
        let first = self.infinite.first(u, self.in_tree, weight)?;
        first.then(|u| self.tree.sample(u))
    }

    pub(crate) fn pmf(&self, light: LightId) -> f32 {
        if self.infinite.is_empty() {
            return self.tree.pmf(light);
        }
        let weight = |light: &StoredInfiniteLight| irradiance(light, &self.ctx);
        let first = self.infinite.first_pmf(light, self.in_tree, weight);
        first.then(|| self.tree.pmf(light))
    }
}

impl InTree for LightBvhAt<'_> {
    #[inline]
    fn sample(&self, u: u64) -> Option<SampledLight> {
        self.sample(u)
    }

    #[inline]
    fn pmf(&self, light: LightId) -> f32 {
        self.pmf(light)
    }
}

impl InTree for LightBvhInCellAt<'_> {
    #[inline]
    fn sample(&self, u: u64) -> Option<SampledLight> {
        self.sample(u)
    }

    #[inline]
    fn pmf(&self, light: LightId) -> f32 {
        self.pmf(light)
    }
}

impl InTree for LightCut<'_> {
    #[inline]
    fn sample(&self, u: u64) -> Option<SampledLight> {
        self.sample(u)
    }

    #[inline]
    fn pmf(&self, light: LightId) -> f32 {
        self.pmf(light)
    }
}
