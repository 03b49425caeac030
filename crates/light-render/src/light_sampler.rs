use lights::bounds::{LightBounds, LightExtent, LightId, LightSampleContext, SampledLight};
use lights::bvh::LightBvhOptions;
use lights::samplers::{
    BvhLightSampler, ExhaustiveLightSampler, InstancedBvhLightSampler, LightChoices, LightSampler,
    PowerLightSampler, PowerLightSamplerError, ReferenceBvhLightSampler, UniformLightSampler,
};
use lights::sources::{LightSet, Rgb};

use crate::placed_tree::{is_mostly_placed, placed_tree};
use crate::sampler_memory::{check_memory, check_memory_beside};
use crate::{
    AnyLightSamplerError, CellLightSampler, ChoiceEstimates, ChoicePlan, PlannedLightSampler,
    SamplerKind, View, VisibilityCells, World,
};

/// A light sampler of any kind, chosen at run time without a virtual call.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum AnyLightSampler {
    /// Every light alike.
    Uniform(UniformLightSampler),
    /// Strong lights more often, wherever they are.
    Power(PowerLightSampler),
    /// Every light by its importance at the point.
    Exhaustive(ExhaustiveLightSampler),
    /// The published light hierarchy.
    BvhReference(ReferenceBvhLightSampler),
    /// The default light hierarchy.
    Bvh(BvhLightSampler),
    /// The default light hierarchy where much light is hidden.
    BvhPlanned(PlannedLightSampler),
    /// The default light hierarchy with cells of visibility.
    BvhInCells(CellLightSampler),
    /// The default light hierarchy of lights that are placed many times: a tree of placed trees.
    BvhPlaced(InstancedBvhLightSampler),
}

impl AnyLightSampler {
    /// The sampler of the given kind over `lights`. The default one is a tree of placed trees
    /// where a million lights and more are [placed]: that needs no
    /// memory for each of them.
    ///
    /// [placed]: lights::sources::LightSetBuilder::place_mesh
    ///
    /// # Errors
    /// When the lights are more than ids, or more than the sampler or the memory can hold.
    pub fn new(kind: SamplerKind, lights: &LightSet<Rgb>) -> Result<Self, AnyLightSamplerError> {
        if kind == SamplerKind::Bvh && is_mostly_placed(lights) {
            return Self::placed(lights);
        }
        check_memory(kind, lights.len())?;
        match kind {
            SamplerKind::Uniform => Self::uniform(lights.len()),
            SamplerKind::Power => Self::by_power(&lights.powers()),
            _ => Self::over(kind, &lights.extents()),
        }
    }

    /// The sampler by these powers; the index is the id.
    ///
    /// # Errors
    /// When the lights are more than ids or than the memory holds, or powers are invalid.
    pub(crate) fn by_power(powers: &[f32]) -> Result<Self, AnyLightSamplerError> {
        check_memory(SamplerKind::Power, powers.len())?;
        Ok(Self::Power(PowerLightSampler::new(powers)?))
    }

    fn uniform(lights: usize) -> Result<Self, AnyLightSamplerError> {
        let most = u32::MAX as usize;
        let too_many = PowerLightSamplerError::TooManyLights { most };
        let count = u32::try_from(lights).map_err(|_| too_many)?;
        Ok(Self::Uniform(UniformLightSampler::new(count)))
    }

    /// A tree of placed trees over `lights`, however few are placed.
    ///
    /// # Errors
    /// When the lights are more than ids, bounds are invalid, or lights that are not placed, or
    /// stretched where they are, do not fit into memory.
    pub fn placed(lights: &LightSet<Rgb>) -> Result<Self, AnyLightSamplerError> {
        placed_tree(lights).map(Self::BvhPlaced)
    }

    /// The sampler of the given kind over lights of the given extents; the index is the id. Powers
    /// are those of the bounds.
    ///
    /// # Errors
    /// When the lights are more than ids or than the memory holds, or bounds are invalid.
    pub fn over(kind: SamplerKind, extents: &[LightExtent]) -> Result<Self, AnyLightSamplerError> {
        check_memory_beside(kind, extents)?;
        Ok(match kind {
            SamplerKind::Uniform => return Self::uniform(extents.len()),
            SamplerKind::Power => {
                let powers: Vec<f32> = extents.iter().map(power).collect();
                Self::Power(PowerLightSampler::new(&powers)?)
            }
            SamplerKind::Exhaustive => Self::Exhaustive(ExhaustiveLightSampler::new(extents)?),
            SamplerKind::BvhReference => {
                Self::BvhReference(ReferenceBvhLightSampler::new(extents)?)
            }
            SamplerKind::Bvh => Self::Bvh(BvhLightSampler::new(extents)?),
            SamplerKind::BvhMorton => Self::Bvh(BvhLightSampler::with_options(
                extents,
                &LightBvhOptions::FAST,
            )?),
        })
    }

    /// The same hierarchy with cells of visibility for what `view` shows of `world`, filled on the
    /// threads of the current `rayon` pool: see [`CellLightSampler::new`].
    ///
    /// # Errors
    /// When the lights are not chosen by the default hierarchy, or the cells are too many.
    pub fn in_cells(
        self,
        world: &World,
        view: &View,
        max_depth: u32,
    ) -> Result<Self, AnyLightSamplerError> {
        let flat = match self {
            // Cells are those of a flat tree.
            Self::BvhPlaced(_) => {
                check_memory(SamplerKind::Bvh, world.lights().len())?;
                Self::over(SamplerKind::Bvh, &world.lights().extents())?
            }
            other => other,
        };
        match flat {
            Self::Bvh(lights) => Ok(Self::BvhInCells(CellLightSampler::new(
                lights, world, view, max_depth,
            )?)),
            _ => Err(AnyLightSamplerError::NoCells),
        }
    }

    /// The same hierarchy with the best plan of the [`ChoiceEstimates`] of what `view` shows of
    /// `world`, over paths of at most `max_depth` segments, and with those cells of visibility that
    /// are estimated to pay for their rays at 64 samples a pixel; other samplers as they are.
    #[must_use]
    pub fn by_estimates(self, world: &World, view: &View, max_depth: u32) -> Self {
        let Self::Bvh(lights) = self else {
            return self;
        };
        let Some(estimates) = ChoiceEstimates::new(world, view, &lights, max_depth) else {
            return Self::Bvh(lights);
        };
        let plan = estimates.best();
        let cells = VisibilityCells::that_pay(world, view, &lights, &estimates);
        if let Some(cells) = cells.ok().filter(|cells| !cells.is_plain()) {
            return Self::BvhInCells(CellLightSampler::with(lights, cells, plan));
        }
        match plan {
            ChoicePlan::AsAsked => Self::Bvh(lights),
            _ => Self::BvhPlanned(PlannedLightSampler::new(lights, plan)),
        }
    }

    /// The default hierarchy, with cells or without; `None` where it is a tree of placed trees.
    pub(crate) const fn hierarchy(&self) -> Option<&BvhLightSampler> {
        match self {
            Self::Bvh(sampler) => Some(sampler),
            Self::BvhPlanned(sampler) => Some(sampler.lights()),
            Self::BvhInCells(sampler) => Some(sampler.lights()),
            Self::Uniform(_)
            | Self::Power(_)
            | Self::Exhaustive(_)
            | Self::BvhReference(_)
            | Self::BvhPlaced(_) => None,
        }
    }

    /// Bytes that queries may touch, for a set of `lights`.
    #[must_use]
    pub fn bytes(&self, lights: usize) -> usize {
        match self {
            Self::Uniform(sampler) => size_of_val(sampler),
            // A bin of the alias table, as its documentation says.
            Self::Power(_) => 12 * lights,
            Self::Exhaustive(_) => size_of::<LightBounds>() * lights,
            Self::BvhReference(sampler) => sampler.tree().stats().bytes,
            Self::Bvh(sampler) => sampler.tree().bytes(),
            Self::BvhPlanned(sampler) => sampler.lights().tree().bytes(),
            Self::BvhInCells(sampler) => sampler.lights().tree().bytes() + sampler.cells().bytes(),
            Self::BvhPlaced(sampler) => sampler.tree().bytes(),
        }
    }

    /// How little a step down the hierarchy narrows a group of lights (see
    /// [`LightBvh::degradation`](lights::bvh::LightBvh::degradation)); `None` for samplers that do
    /// not know.
    #[must_use]
    pub fn degradation(&self) -> Option<f64> {
        match self {
            Self::BvhPlaced(sampler) => Some(sampler.tree().top().degradation()),
            _ => Some(self.hierarchy()?.tree().degradation()),
        }
    }

    /// Nodes on the longest way down a hierarchy; 0 without one.
    #[must_use]
    pub fn depth(&self) -> usize {
        match self {
            Self::Uniform(_) | Self::Power(_) | Self::Exhaustive(_) => 0,
            Self::BvhReference(sampler) => sampler.tree().stats().max_depth as usize,
            Self::Bvh(sampler) => sampler.tree().depth(),
            Self::BvhPlanned(sampler) => sampler.lights().tree().depth(),
            Self::BvhInCells(sampler) => sampler.lights().tree().depth(),
            Self::BvhPlaced(sampler) => {
                let depths = sampler.tree().prototypes().iter();
                let lower = depths.map(|prototype| prototype.depth()).max();
                sampler.tree().top().depth() + lower.unwrap_or(0)
            }
        }
    }
}

/// The power of the bounds.
fn power(extent: &LightExtent) -> f32 {
    match extent {
        LightExtent::Bounded(bounds) | LightExtent::Lobe(bounds, _) => bounds.phi,
        LightExtent::Infinite(bounds) => bounds.fluence,
    }
}

/// The same query for whichever sampler it is.
macro_rules! for_each_kind {
    ($sampler:expr, $it:ident => $answer:expr) => {
        match $sampler {
            AnyLightSampler::Uniform($it) => $answer,
            AnyLightSampler::Power($it) => $answer,
            AnyLightSampler::Exhaustive($it) => $answer,
            AnyLightSampler::BvhReference($it) => $answer,
            AnyLightSampler::Bvh($it) => $answer,
            AnyLightSampler::BvhPlanned($it) => $answer,
            AnyLightSampler::BvhInCells($it) => $answer,
            AnyLightSampler::BvhPlaced($it) => $answer,
        }
    };
}

impl LightSampler for AnyLightSampler {
    #[inline]
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        for_each_kind!(self, sampler => sampler.sample(ctx, u))
    }

    #[inline]
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        for_each_kind!(self, sampler => sampler.pmf(ctx, light))
    }

    #[inline]
    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        for_each_kind!(self, sampler => sampler.sample_emitter(u))
    }

    #[inline]
    fn pmf_emitter(&self, light: LightId) -> f32 {
        for_each_kind!(self, sampler => sampler.pmf_emitter(light))
    }

    #[inline]
    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        for_each_kind!(self, sampler => sampler.at(ctx, count))
    }
}
