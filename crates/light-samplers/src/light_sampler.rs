use core::fmt;

use light_bounds::light_math::fraction::stratum;
use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_bvh::visibility::LightBvhInCellAt;
use light_bvh::{LightBvhAt, LightBvhRef, LightCut};

use crate::bvh_choices::BvhChoices;
use crate::infinite_lights::InfiniteLights;
#[cfg(feature = "alloc")]
use crate::placed_lights_at::PlacedLightsAt;

/// Chooses lights of a set at random, with probabilities that can be queried.
///
/// Every `u` is a [fraction](light_bounds::light_math::fraction) of 2^64. Samplers are immutable
/// and deterministic in their arguments. For any input, and in every implementation:
///
/// - the pmf of a sample has the same bits as the queried pmf of its light;
/// - the pmfs of all lights and the probability of `None` add up to 1;
/// - a light that contributes at the context has a pmf above 0;
/// - a light that the sampler does not know has pmf 0.
pub trait LightSampler {
    /// One light that may light `ctx`; `None` means that this choice contributes nothing.
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight>;

    /// Probability that [`sample`](Self::sample) at `ctx` returns `light`.
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32;

    /// The choice of `count` lights at `ctx`, one by one from equal parts of `[0, 1)`.
    ///
    /// A sampler may keep what it has computed for `ctx`, and refine its estimates for several
    /// choices: the probabilities are then those of [`LightChoices::pmf`]. It may make fewer
    /// choices where fewer serve better: [`LightChoices::count`] says how many. One without such
    /// work returns [`LightChoices::one_by_one`]. The example [`many_lights`][1] lights a plain
    /// by it.
    ///
    /// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/many_lights.rs
    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a>;

    /// One light to emit from, without a receiver, as in light tracing; `None` if nothing emits.
    fn sample_emitter(&self, u: u64) -> Option<SampledLight>;

    /// Probability that [`sample_emitter`](Self::sample_emitter) returns `light`.
    fn pmf_emitter(&self, light: LightId) -> f32;
}

impl<S: LightSampler + ?Sized> LightSampler for &S {
    #[inline]
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        (**self).sample(ctx, u)
    }

    #[inline]
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        (**self).pmf(ctx, light)
    }

    #[inline]
    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        (**self).at(ctx, count)
    }

    #[inline]
    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        (**self).sample_emitter(u)
    }

    #[inline]
    fn pmf_emitter(&self, light: LightId) -> f32 {
        (**self).pmf_emitter(light)
    }
}

/// What a sampler knows at one context, for a number of choices there:
/// [`at`](LightSampler::at) makes it.
///
/// ```
/// # use light_samplers::{LightSampler, UniformLightSampler, light_bounds};
/// # use light_bounds::{LightSampleContext, glam::Vec3};
/// let sampler = UniformLightSampler::new(100);
/// let here = sampler.at(&LightSampleContext::medium(Vec3::ZERO), 4);
/// let mut estimate = 0.0;
/// for choice in here.samples(0x1234_5678_9abc_def0) {
///     let irradiance = 1.0; // of `choice.light`
///     estimate += irradiance / choice.pmf / here.count() as f32;
/// }
/// assert_eq!(estimate, 100.0);
/// ```
#[derive(Clone, Debug)]
pub struct LightChoices<'a> {
    count: u32,
    kind: Kind<'a>,
}

#[derive(Clone)]
#[expect(clippy::large_enum_variant, reason = "a box needs an allocator")]
enum Kind<'a> {
    OneByOne {
        sampler: &'a dyn LightSampler,
        ctx: LightSampleContext,
    },
    /// Each from the root.
    FromRoot(BvhChoices<'a, LightBvhAt<'a>>),
    /// From groups that were opened before.
    Cut(BvhChoices<'a, LightCut<'a>>),
    /// Each from the root, with the factors of a cell.
    InCell(BvhChoices<'a, LightBvhInCellAt<'a>>),
    /// Each from the root of a tree of trees.
    #[cfg(feature = "alloc")]
    InPlacements(BvhChoices<'a, PlacedLightsAt<'a>>),
}

impl fmt::Debug for Kind<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OneByOne { ctx, .. } => f.debug_tuple("OneByOne").field(ctx).finish(),
            Self::FromRoot(choices) => choices.fmt(f),
            Self::Cut(choices) => choices.fmt(f),
            Self::InCell(choices) => choices.fmt(f),
            #[cfg(feature = "alloc")]
            Self::InPlacements(choices) => choices.fmt(f),
        }
    }
}

/// No choice.
impl Default for LightChoices<'_> {
    #[inline]
    fn default() -> Self {
        Self {
            count: 0,
            kind: Kind::Cut(BvhChoices::default()),
        }
    }
}

impl<'a> LightChoices<'a> {
    /// `count` choices at `ctx`, each as [`LightSampler::sample`] makes it.
    #[inline]
    #[must_use]
    pub const fn one_by_one(
        sampler: &'a dyn LightSampler,
        ctx: &LightSampleContext,
        count: u32,
    ) -> Self {
        let ctx = *ctx;
        let kind = Kind::OneByOne { sampler, ctx };
        Self { count, kind }
    }

    #[inline]
    pub(crate) const fn from_root(choices: BvhChoices<'a, LightBvhAt<'a>>, count: u32) -> Self {
        let kind = Kind::FromRoot(choices);
        Self { count, kind }
    }

    #[inline]
    pub(crate) const fn in_cell(choices: BvhChoices<'a, LightBvhInCellAt<'a>>, count: u32) -> Self {
        let kind = Kind::InCell(choices);
        Self { count, kind }
    }

    #[cfg(feature = "alloc")]
    #[inline]
    pub(crate) const fn in_placements(
        choices: BvhChoices<'a, PlacedLightsAt<'a>>,
        count: u32,
    ) -> Self {
        let kind = Kind::InPlacements(choices);
        Self { count, kind }
    }

    /// Makes these `count` choices at `ctx` among the lights of a tree of this power and those at
    /// infinity, by a cut, in place.
    #[inline]
    pub(crate) fn set_cut(
        &mut self,
        tree: &LightBvhRef<'a>,
        power: f32,
        infinite: InfiniteLights<'a>,
        ctx: &LightSampleContext,
        count: u32,
    ) {
        self.count = count;
        if !matches!(self.kind, Kind::Cut(_)) {
            self.kind = Kind::Cut(BvhChoices::default());
        }
        if let Kind::Cut(choices) = &mut self.kind {
            choices.set(tree, power, infinite, ctx);
        }
    }

    /// Another number of choices with the same probabilities: a single one of those that a sampler
    /// has refined for several, for example.
    ///
    /// ```
    /// # use light_samplers::{LightSampler, UniformLightSampler, light_bounds};
    /// # use light_bounds::{LightSampleContext, glam::Vec3};
    /// let sampler = UniformLightSampler::new(100);
    /// let here = sampler.at(&LightSampleContext::medium(Vec3::ZERO), 2).with_count(1);
    /// assert_eq!(here.samples(1 << 63).count(), 1);
    /// ```
    #[inline]
    #[must_use]
    pub const fn with_count(mut self, count: u32) -> Self {
        self.count = count;
        self
    }

    /// How many choices there are. An estimate is the sum over the choices of what each gives over
    /// its pmf, divided by this number: also where fewer come back, since a choice that is left out
    /// contributes nothing.
    #[inline]
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }

    /// A light for each of the equal parts of `[0, 1)`, at the relative position `u` in each part;
    /// none where a choice contributes nothing.
    #[inline]
    pub fn samples(&self, u: u64) -> impl Iterator<Item = SampledLight> + use<'_, 'a> {
        (0..self.count).filter_map(move |i| self.sample(stratum(i, self.count, u)))
    }

    /// One light that may light the context; `None` means that this choice contributes nothing.
    #[must_use]
    pub fn sample(&self, u: u64) -> Option<SampledLight> {
        match &self.kind {
            Kind::OneByOne { sampler, ctx } => sampler.sample(ctx, u),
            Kind::FromRoot(choices) => choices.sample(u),
            Kind::Cut(choices) => choices.sample(u),
            Kind::InCell(choices) => choices.sample(u),
            #[cfg(feature = "alloc")]
            Kind::InPlacements(choices) => choices.sample(u),
        }
    }

    /// Probability that one of the choices is `light`, on average over them, with the same bits as
    /// that of a sample. Multiple importance sampling sets [`count`](Self::count) times this, times
    /// the density of the light, against the density of one sample of another strategy.
    #[must_use]
    pub fn pmf(&self, light: LightId) -> f32 {
        match &self.kind {
            Kind::OneByOne { sampler, ctx } => sampler.pmf(ctx, light),
            Kind::FromRoot(choices) => choices.pmf(light),
            Kind::Cut(choices) => choices.pmf(light),
            Kind::InCell(choices) => choices.pmf(light),
            #[cfg(feature = "alloc")]
            Kind::InPlacements(choices) => choices.pmf(light),
        }
    }
}
