use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_bvh::visibility::{CellFactors, LightBvhInCellAt};
use light_bvh::{LightBvhAt, LightBvhRef};

use crate::bvh_choices::BvhChoices;
use crate::infinite_lights::{InfiniteLights, InfiniteLightsError, StoredInfiniteLight};
use crate::{LightChoices, LightSampler};

/// The least number of choices for which a cut is faster than single choices.
const FEWEST_OF_CUT: u32 = 2;

/// [`BvhLightSampler`](crate::BvhLightSampler) on borrowed memory, for a tree in flash, in a mapped
/// file or in a buffer; needs no allocator.
#[derive(Clone, Copy, Debug)]
pub struct BvhLightSamplerRef<'a> {
    pub(crate) tree: LightBvhRef<'a>,
    pub(crate) power: f32,
    pub(crate) infinite: InfiniteLights<'a>,
}

impl<'a> BvhLightSamplerRef<'a> {
    /// A sampler of the lights of `tree`, whose power is `power`, and of lights at infinity in
    /// ascending order of their ids, none of which is in the tree.
    ///
    /// # Errors
    /// If the lights at infinity are not in order, or have no valid bounds. It is not checked that
    /// the tree does not hold them: they are never chosen from it.
    pub fn new(
        tree: LightBvhRef<'a>,
        power: f32,
        infinite: &'a [StoredInfiniteLight],
    ) -> Result<Self, InfiniteLightsError> {
        Ok(Self {
            tree,
            power,
            infinite: InfiniteLights::new(infinite)?,
        })
    }

    /// The tree of the lights with a position.
    #[must_use]
    pub const fn tree(&self) -> LightBvhRef<'a> {
        self.tree
    }

    /// The power of the lights of the tree.
    #[must_use]
    pub const fn power(&self) -> f32 {
        self.power
    }

    /// The lights at infinity that emit, in ascending order of their ids.
    #[must_use]
    pub const fn infinite_lights(&self) -> &'a [StoredInfiniteLight] {
        self.infinite.lights()
    }

    /// Whether a query is one of the tree alone. Without an operating system memory for code is
    /// short: there all take the way of those with lights at infinity, which gives the same bits.
    #[inline(always)]
    const fn is_tree_alone(&self) -> bool {
        cfg!(not(target_os = "none")) && self.infinite.is_empty()
    }

    /// A single choice.
    #[inline]
    fn choice_at(&self, ctx: &LightSampleContext) -> BvhChoices<'a, LightBvhAt<'a>> {
        BvhChoices::from_root(self.tree, self.power, self.infinite, ctx)
    }

    /// [`LightSampler::at`], for as long as the memory is borrowed.
    #[must_use]
    pub(crate) fn choices_at(&self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        if count < FEWEST_OF_CUT {
            LightChoices::from_root(self.choice_at(ctx), count)
        } else {
            let mut choices = LightChoices::default();
            choices.set_cut(&self.tree, self.power, self.infinite, ctx, count);
            choices
        }
    }

    /// [`LightSampler::at`] in a place of the caller, which several choices by a cut do not leave:
    /// no 2 KB are moved, where memory is short or slow.
    ///
    /// ```
    /// # use light_samplers::{BvhLightSampler, LightChoices, LightSampler};
    /// # use light_samplers::{light_bounds, light_math};
    /// # use light_bounds::{LightBounds, LightExtent, LightSampleContext, glam::Vec3};
    /// # let bounds = LightBounds {
    /// #     bounds: light_math::Aabb::from_point(Vec3::Y),
    /// #     w: Vec3::Z,
    /// #     phi: 1.0,
    /// #     cos_theta_o: -1.0,
    /// #     cos_theta_e: 0.0,
    /// #     two_sided: false,
    /// # };
    /// # let lights = vec![LightExtent::Bounded(bounds); 100];
    /// let sampler = BvhLightSampler::new(&lights)?;
    /// let (sampler, mut here) = (sampler.view(), LightChoices::default());
    /// for p in [Vec3::ZERO, Vec3::X] {
    ///     let ctx = LightSampleContext::medium(p);
    ///     sampler.set_at(&ctx, 4, &mut here);
    ///     assert_eq!(here.samples(1 << 63).count(), 4);
    ///     assert!(here.samples(1 << 63).eq(sampler.at(&ctx, 4).samples(1 << 63)));
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_at(&self, ctx: &LightSampleContext, count: u32, choices: &mut LightChoices<'a>) {
        if count < FEWEST_OF_CUT {
            *choices = self.choices_at(ctx, count);
        } else {
            choices.set_cut(&self.tree, self.power, self.infinite, ctx, count);
        }
    }

    /// A single choice in `cell`.
    #[inline]
    pub(crate) fn choice_in<'b>(
        &self,
        cell: CellFactors<'b>,
        ctx: &LightSampleContext,
    ) -> BvhChoices<'b, LightBvhInCellAt<'b>>
    where
        'a: 'b,
    {
        BvhChoices::in_cell(self.tree, self.power, self.infinite, cell, ctx)
    }

    /// `count` choices in `cell`, each from the root.
    #[inline]
    pub(crate) fn choices_in<'b>(
        &self,
        cell: CellFactors<'b>,
        ctx: &LightSampleContext,
        count: u32,
    ) -> LightChoices<'b>
    where
        'a: 'b,
    {
        LightChoices::in_cell(self.choice_in(cell, ctx), count)
    }
}

impl LightSampler for BvhLightSamplerRef<'_> {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        if self.is_tree_alone() {
            self.tree.sample(ctx, u)
        } else {
            self.choice_at(ctx).sample(u)
        }
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        if self.is_tree_alone() {
            self.tree.pmf(ctx, light)
        } else {
            self.choice_at(ctx).pmf(light)
        }
    }

    fn at<'b>(&'b self, ctx: &LightSampleContext, count: u32) -> LightChoices<'b> {
        self.choices_at(ctx, count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        let first = self
            .infinite
            .first(u, self.power, StoredInfiniteLight::fluence)?;
        first.then(|u| self.tree.sample_emitter(u))
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        let power = self.power;
        let first = self
            .infinite
            .first_pmf(light, power, StoredInfiniteLight::fluence);
        first.then(|| self.tree.pmf_emitter(light))
    }
}
