use lights::bounds::{LightId, LightSampleContext, SampledLight};
use lights::bvh::prefetch_item;
use lights::glam::{Vec2, Vec3};
use lights::math::distribution::WeightedReservoir;
use lights::samplers::{LightChoices, LightSampler};
use lights::sources::{Light, LightType};

use super::Estimator;
use super::chosen_lights::ChosenLights;
use crate::{SampleStream, VertexNumbers, World};

/// How lights are chosen at a vertex. It is kept while the path goes on: a light that the next ray
/// finds is weighted by the density of these choices.
#[derive(Clone, Debug)]
pub(super) struct LightQuery<'a> {
    ctx: LightSampleContext,
    choices: LightChoices<'a>,
}

/// Next-event estimation: direct light by the lights that a sampler chooses.
#[derive(Clone, Copy, Debug)]
pub(super) struct DirectLight<'a, S> {
    pub(super) world: &'a World,
    pub(super) sampler: &'a S,
    pub(super) estimator: Estimator,
}

/// A scattering function at a point: the BSDF of a surface or the phase function of a medium.
pub(super) trait Scatters {
    /// Scattering function times cosine, or phase function, in sr^-1.
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3;

    /// The density of directions that it samples, in sr^-1.
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32;
}

/// A vertex that is lit: its scattering function and the direction to the viewer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex<'a, V> {
    pub(super) scattering: &'a V,
    pub(super) wo: Vec3,
    /// Its number along the path, from 0 on.
    pub(super) number: u32,
}

/// The contribution of a light sample to a vertex, without occlusion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unshadowed {
    light: LightId,
    radiance: Vec3,
    pub(super) wi: Vec3,
    pub(super) p_light: Vec3,
    pub(super) kind: LightType,
}

/// The direct light at a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lit {
    /// The light that it comes from; `None` where it is zero.
    pub(super) light: Option<LightId>,
    pub(super) radiance: Vec3,
    /// How many rays were traced.
    pub(super) rays: u32,
}

/// The transmittance between a light sample and a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrived {
    /// The transmittance; 0 if the light is occluded.
    pub(super) left: Vec3,
    /// How many rays were traced.
    pub(super) rays: u32,
}

impl Arrived {
    /// Zero transmittance, found by so many rays.
    pub(super) const fn nothing(rays: u32) -> Self {
        let left = Vec3::ZERO;
        Self { left, rays }
    }
}

impl<'a, S: LightSampler> DirectLight<'a, S> {
    /// Direct light in `world` by the lights that `sampler` chooses.
    pub(super) fn new(world: &'a World, sampler: &'a S, estimator: Estimator) -> Self {
        Self {
            world,
            sampler,
            estimator,
        }
    }

    /// The choice of `count` lights at `ctx`.
    #[inline]
    pub(super) fn query(&self, ctx: LightSampleContext, count: u32) -> LightQuery<'a> {
        let choices = self.sampler.at(&ctx, count);
        LightQuery { ctx, choices }
    }

    /// Chooses the lights of `query`, and prefetches their data.
    #[inline]
    pub(super) fn choose(&self, query: &LightQuery<'_>, numbers: &VertexNumbers) -> ChosenLights {
        let lights = self.world.lights();
        let mut chosen = ChosenLights::default();
        for choice in query.choices.samples(numbers.light) {
            if let Some(corners) = lights.corners(choice.light) {
                prefetch_item(corners);
            }
            chosen.push(choice);
        }
        chosen
    }

    /// Direct light from the `chosen` lights that `vertex` scatters toward its viewer, with one
    /// shadow ray for all of them: an unbiased estimate that costs little more than that of a
    /// single light. `query` is that of [`choose`](Self::choose).
    ///
    /// `arrived` returns the transmittance of the one light sample that is tested.
    #[inline]
    pub(super) fn sample<V: Scatters>(
        &self,
        query: &LightQuery<'_>,
        chosen: &ChosenLights,
        vertex: &Vertex<'_, V>,
        numbers: &VertexNumbers,
        stream: &SampleStream,
        arrived: impl FnOnce(&Unshadowed) -> Arrived,
    ) -> Lit {
        let (world, estimator) = (self.world, self.estimator);
        // Resampling: a candidate is tested with a probability in proportion to its contribution.
        let mut candidates = WeightedReservoir::new();
        for (number, choice) in (0..).zip(chosen.iter()) {
            let point = stream.light_point(vertex.number, number, query.choices.count());
            if let Some(candidate) = unshadowed(world, estimator, query, vertex, choice, point) {
                let weight = candidate.radiance.element_sum();
                let u = numbers.shadow_of(candidates.count());
                candidates.add(candidate, weight, weight, u);
            }
        }
        let Some(chosen) = candidates.value() else {
            return Lit {
                light: None,
                radiance: Vec3::ZERO,
                rays: 0,
            };
        };
        // The sum over all candidates, not their mean: a candidate is divided by their number.
        let weight = candidates.contribution_weight_among(1);
        let Arrived { left, rays } = arrived(chosen);
        Lit {
            light: Some(chosen.light),
            radiance: left * chosen.radiance * weight,
            rays,
        }
    }

    /// The density of light samples, in sr^-1, that the choices of `query` have in the direction
    /// `wi` toward `light`: the expected number of samples per solid angle.
    #[inline]
    pub(super) fn density(&self, query: &LightQuery<'_>, light: LightId, wi: Vec3) -> f32 {
        let LightQuery { ctx, choices } = query;
        let Some(source) = self.world.lights().get(light) else {
            return 0.0;
        };
        let pmf = choices.count() as f32 * choices.pmf(light);
        if pmf > 0.0 {
            pmf * source.pdf_li(ctx, wi, self.estimator.coverage())
        } else {
            0.0
        }
    }
}

/// The contribution of one chosen light to [`DirectLight::sample`] without occlusion; `None` if it
/// is zero.
#[inline]
fn unshadowed<V: Scatters>(
    world: &World,
    estimator: Estimator,
    query: &LightQuery<'_>,
    vertex: &Vertex<'_, V>,
    choice: SampledLight,
    u_point: Vec2,
) -> Option<Unshadowed> {
    let Vertex { scattering, wo, .. } = *vertex;
    let light = world.lights().get(choice.light)?;
    let coverage = estimator.coverage();
    let sample = world.sample_light(choice.light, &query.ctx, u_point, coverage)?;
    if is_in_the_surface(&query.ctx, sample.p_light) {
        return None;
    }
    let scattered = scattering.eval(wo, sample.wi) * sample.l;
    if scattered == Vec3::ZERO {
        return None;
    }
    let density = query.choices.count() as f32 * choice.pmf * sample.pdf;
    let kind = light.light_type();
    let weight = estimator.light_weight(kind, density, || scattering.pdf(wo, sample.wi));
    Some(Unshadowed {
        light: choice.light,
        radiance: scattered * (weight / density),
        wi: sample.wi,
        p_light: sample.p_light,
        kind,
    })
}

/// Whether a point of a light is within the rounding error of the receiving surface: an emitter
/// does not light its own back. Rays start beyond that error, so that BSDF samples do not find such
/// light either.
#[inline]
pub(crate) fn is_in_the_surface(ctx: &LightSampleContext, p_light: Vec3) -> bool {
    ctx.n()
        .is_some_and(|n| (p_light - ctx.p).dot(n).abs() < n.abs().dot(ctx.p_error))
}
