use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_bvh::visibility::{CellFactors, LightBvhInCellAt};
use light_bvh::{CutDetail, LightBvhAt, LightBvhRef, LightCut};
use light_math::float::positive_product;

use crate::first_choice::{FirstChoice, FirstPmf};
use crate::infinite_lights::{InfiniteLight, InfiniteLights, irradiance};

/// The least number of choices for which a cut is faster than single choices.
const FEWEST_OF_CUT: u32 = 2;

/// The default hierarchy and its lights at infinity at one context.
///
/// A single choice has another type than several choices, so that a program that makes single ones
/// only has neither the code of a cut nor its size on the stack.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BvhChoices<'a, T = TreeChoices<'a>> {
    infinite: InfiniteLights<'a>,
    ctx: LightSampleContext,
    /// Estimated irradiance from the lights of the tree; not needed without lights at infinity.
    in_tree: f32,
    tree: T,
}

/// The tree at the context.
pub(crate) trait InTree {
    /// As [`LightBvhAt::irradiance`].
    fn irradiance(&self) -> f32;

    /// As [`LightBvhAt::sample`].
    fn sample(&self, u: u64) -> Option<SampledLight>;

    /// As [`LightBvhAt::pmf`].
    fn pmf(&self, light: LightId) -> f32;
}

#[derive(Clone, Copy, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "a box needs an allocator, and choices are made in place"
)]
pub(crate) enum TreeChoices<'a> {
    /// Each from the root.
    Single(LightBvhAt<'a>),
    /// From groups that were opened before.
    Cut(LightCut<'a>),
    /// Each from the root, with the factors of a cell.
    InCell(LightBvhInCellAt<'a>),
}

impl<'a> BvhChoices<'a> {
    /// For `count` choices at `ctx` among the lights of a tree of this power and those at infinity.
    #[inline]
    pub(crate) fn new(
        tree: LightBvhRef<'a>,
        power: f32,
        infinite: InfiniteLights<'a>,
        ctx: &LightSampleContext,
        count: u32,
    ) -> Self {
        let tree = if count < FEWEST_OF_CUT {
            TreeChoices::Single(tree.at(ctx))
        } else {
            TreeChoices::Cut(tree.cut(ctx, CutDetail::default()))
        };
        Self::of(tree, power, infinite, ctx)
    }

    /// The same with the factors of `cell`.
    #[inline]
    pub(crate) fn in_cell(
        tree: LightBvhRef<'a>,
        power: f32,
        infinite: InfiniteLights<'a>,
        cell: CellFactors<'a>,
        ctx: &LightSampleContext,
    ) -> Self {
        let tree = TreeChoices::InCell(tree.in_cell(cell).at(ctx));
        Self::of(tree, power, infinite, ctx)
    }
}

impl<'a> BvhChoices<'a, LightBvhInCellAt<'a>> {
    /// The same for a single choice.
    #[inline]
    pub(crate) fn single_in_cell(
        tree: LightBvhRef<'a>,
        power: f32,
        infinite: InfiniteLights<'a>,
        cell: CellFactors<'a>,
        ctx: &LightSampleContext,
    ) -> Self {
        Self::of(tree.in_cell(cell).at(ctx), power, infinite, ctx)
    }
}

impl<'a> BvhChoices<'a, LightBvhAt<'a>> {
    /// The same for a single choice.
    #[inline]
    pub(crate) fn single(
        tree: LightBvhRef<'a>,
        power: f32,
        infinite: InfiniteLights<'a>,
        ctx: &LightSampleContext,
    ) -> Self {
        Self::of(tree.at(ctx), power, infinite, ctx)
    }
}

impl<'a, T: InTree> BvhChoices<'a, T> {
    #[inline]
    fn of(tree: T, power: f32, infinite: InfiniteLights<'a>, ctx: &LightSampleContext) -> Self {
        Self {
            infinite,
            ctx: *ctx,
            in_tree: positive_product(tree.irradiance(), power).min(f32::MAX),
            tree,
        }
    }

    #[inline]
    pub(crate) fn sample(&self, u: u64) -> Option<SampledLight> {
        if self.infinite.is_empty() {
            return self.tree.sample(u);
        }
        let weight = |light: &InfiniteLight| irradiance(light, &self.ctx);
        match self.infinite.first(u, self.in_tree, weight)? {
            FirstChoice::Infinite(light) => Some(light),
            FirstChoice::Others { pmf, u } => self.tree.sample(u).map(|light| SampledLight {
                pmf: positive_product(pmf, light.pmf),
                ..light
            }),
        }
    }

    #[inline]
    pub(crate) fn pmf(&self, light: LightId) -> f32 {
        if self.infinite.is_empty() {
            return self.tree.pmf(light);
        }
        let weight = |light: &InfiniteLight| irradiance(light, &self.ctx);
        match self.infinite.first_pmf(light, self.in_tree, weight) {
            FirstPmf::Infinite(pmf) => pmf,
            FirstPmf::Others(pmf) => positive_product(pmf, self.tree.pmf(light)),
        }
    }
}

impl InTree for LightBvhAt<'_> {
    #[inline]
    fn irradiance(&self) -> f32 {
        self.irradiance()
    }

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
    fn irradiance(&self) -> f32 {
        self.irradiance()
    }

    #[inline]
    fn sample(&self, u: u64) -> Option<SampledLight> {
        self.sample(u)
    }

    #[inline]
    fn pmf(&self, light: LightId) -> f32 {
        self.pmf(light)
    }
}

impl InTree for TreeChoices<'_> {
    #[inline]
    fn irradiance(&self) -> f32 {
        match self {
            Self::Single(tree) => tree.irradiance(),
            Self::Cut(tree) => tree.irradiance(),
            Self::InCell(tree) => tree.irradiance(),
        }
    }

    #[inline]
    fn sample(&self, u: u64) -> Option<SampledLight> {
        match self {
            Self::Single(tree) => tree.sample(u),
            Self::Cut(tree) => tree.sample(u),
            Self::InCell(tree) => tree.sample(u),
        }
    }

    #[inline]
    fn pmf(&self, light: LightId) -> f32 {
        match self {
            Self::Single(tree) => tree.pmf(light),
            Self::Cut(tree) => tree.pmf(light),
            Self::InCell(tree) => tree.pmf(light),
        }
    }
}
