use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_bvh::{CutDetail, LightBvhAt, LightBvhRef, LightCut};
use light_math::float::positive_product;

use crate::first_choice::{FirstChoice, FirstPmf};
use crate::infinite_lights::{InfiniteLight, InfiniteLights, irradiance};

/// The least number of choices for which a cut is faster than single choices.
const FEWEST_OF_CUT: u32 = 2;

/// What the default hierarchy and its lights at infinity know at one context.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BvhChoices<'a> {
    infinite: InfiniteLights<'a>,
    ctx: LightSampleContext,
    /// Estimated irradiance from the lights of the tree; not needed without lights at infinity.
    in_tree: f32,
    tree: TreeChoices<'a>,
}

#[derive(Clone, Copy, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "a box needs an allocator, and choices are made in place"
)]
enum TreeChoices<'a> {
    /// Each from the root.
    Single(LightBvhAt<'a>),
    /// From groups that were opened before.
    Cut(LightCut<'a>),
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
        let of_unit_power = match &tree {
            TreeChoices::Single(tree) => tree.irradiance(),
            TreeChoices::Cut(tree) => tree.irradiance(),
        };
        Self {
            infinite,
            ctx: *ctx,
            in_tree: positive_product(of_unit_power, power).min(f32::MAX),
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

impl TreeChoices<'_> {
    #[inline]
    fn sample(&self, u: u64) -> Option<SampledLight> {
        match self {
            Self::Single(tree) => tree.sample(u),
            Self::Cut(tree) => tree.sample(u),
        }
    }

    #[inline]
    fn pmf(&self, light: LightId) -> f32 {
        match self {
            Self::Single(tree) => tree.pmf(light),
            Self::Cut(tree) => tree.pmf(light),
        }
    }
}
