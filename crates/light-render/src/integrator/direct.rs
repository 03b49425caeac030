use lights::bounds::{LightId, LightSampleContext, SampledLight};
use lights::bvh::prefetch_item;
use lights::glam::{Vec2, Vec3};
use lights::math::distribution::WeightedReservoir;
use lights::samplers::{LightSampler, PreparedChoices};
use lights::sources::{Light, LightType};

use super::chosen::ChosenLights;
use super::{Estimator, Traced};
use crate::bsdf::Scattering;
use crate::{SampleStream, VertexNumbers, World};

/// How a vertex of a path asks for light: kept until the next ray is known to miss or to find a
/// light, because both strategies weigh their samples by the same densities.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightQuery {
    pub(super) ctx: LightSampleContext,
    /// How many lights are chosen at once; not 0.
    pub(super) count: u32,
}

/// What all vertices of a path share.
#[derive(Debug)]
pub(super) struct DirectLight<'a, S> {
    pub(super) world: &'a World,
    pub(super) sampler: &'a S,
    pub(super) estimator: Estimator,
    /// What the sampler found out where it chose last.
    prepared: PreparedChoices,
}

/// What scatters light at a point: a surface, or a surface or a medium.
pub(super) trait Scatters {
    /// Scattering function times cosine, or phase function, in sr^-1.
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3;

    /// The density of directions that it samples, in sr^-1.
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32;
}

impl Scatters for Scattering {
    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        self.eval(wo, wi)
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.pdf(wo, wi)
    }
}

/// Where light is asked for: what scatters it, and who looks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex<'a, V> {
    pub(super) scattering: &'a V,
    pub(super) wo: Vec3,
    /// Its number along the path, from 0 on.
    pub(super) number: u32,
}

/// What a light sends over a vertex if nothing is in the way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unshadowed {
    radiance: Vec3,
    pub(super) wi: Vec3,
    pub(super) p_light: Vec3,
    pub(super) kind: LightType,
}

/// What became of light on its way to a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrived {
    /// The share that is left.
    pub(super) left: Vec3,
    /// Rays that it took to know.
    pub(super) rays: u32,
}

impl Arrived {
    /// Everything was lost, after so many rays.
    pub(super) const fn nothing(rays: u32) -> Self {
        let left = Vec3::ZERO;
        Self { left, rays }
    }
}

impl<'a, S: LightSampler> DirectLight<'a, S> {
    /// Light of `world` by the lights that `sampler` chooses.
    pub(super) fn new(world: &'a World, sampler: &'a S, estimator: Estimator) -> Self {
        Self {
            world,
            sampler,
            estimator,
            prepared: PreparedChoices::default(),
        }
    }

    /// As many lights as `query` says, which memory brings nearer while something else is done.
    #[inline]
    pub(super) fn choose(&mut self, query: &LightQuery, numbers: &VertexNumbers) -> ChosenLights {
        let LightQuery { ctx, count } = query;
        let lights = self.world.lights();
        let mut chosen = ChosenLights::default();
        let mut each = |choice: SampledLight| {
            if let Some(corners) = lights.corners(choice.light) {
                prefetch_item(corners);
            }
            chosen.push(choice);
        };
        let prepared = &mut self.prepared;
        self.sampler
            .sample_many_prepared(ctx, numbers.light, *count, prepared, &mut each);
        chosen
    }

    /// The light that the `chosen` lights send over `vertex` toward its viewer, with one shadow ray
    /// for all of them: an unbiased estimate that costs little more than that of a single light.
    /// They are those of [`choose`](Self::choose) for the same query.
    ///
    /// `arrived` says what is left of the light of the one whose shadow counts for all.
    #[inline]
    pub(super) fn sample<V: Scatters>(
        &self,
        query: &LightQuery,
        chosen: &ChosenLights,
        vertex: &Vertex<'_, V>,
        numbers: &VertexNumbers,
        stream: &SampleStream,
        arrived: impl FnOnce(&Unshadowed) -> Arrived,
    ) -> Traced {
        let (world, estimator) = (self.world, self.estimator);
        // The more a candidate would give, the more likely it is the one whose shadow is looked at.
        let mut candidates = WeightedReservoir::new(numbers.shadow.into());
        for (number, choice) in (0..).zip(chosen.iter()) {
            let point = stream.light_point(vertex.number, number, query.count);
            if let Some(candidate) = unshadowed(world, estimator, query, vertex, choice, point) {
                candidates.add(candidate, candidate.radiance.element_sum());
            }
        }
        let Some(chosen) = candidates.sample() else {
            return Traced::default();
        };
        let Arrived { left, rays } = arrived(&chosen.value);
        Traced {
            radiance: left * chosen.value.radiance / chosen.pmf,
            rays,
        }
    }

    /// The expected number of samples per sr that [`sample`](Self::sample) takes in the direction
    /// `wi` toward `light`; `query` is the one that it was asked last.
    #[inline]
    pub(super) fn density(&self, query: &LightQuery, light: LightId, wi: Vec3) -> f32 {
        let LightQuery { ctx, count } = query;
        let Some(source) = self.world.lights().get(light) else {
            return 0.0;
        };
        let pmf = self
            .sampler
            .pmf_many_prepared(ctx, light, *count, &self.prepared);
        let pmf = *count as f32 * pmf;
        if pmf > 0.0 {
            pmf * source.pdf_li(ctx, wi, self.estimator.coverage())
        } else {
            0.0
        }
    }
}

/// The share that one chosen light has in [`DirectLight::sample`] if nothing is in the way; `None`
/// if it has none.
#[inline]
fn unshadowed<V: Scatters>(
    world: &World,
    estimator: Estimator,
    query: &LightQuery,
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
    let density = query.count as f32 * choice.pmf * sample.pdf;
    let kind = light.light_type();
    let weight = if kind.is_delta() {
        1.0
    } else {
        estimator.light_weight(density, scattering.pdf(wo, sample.wi))
    };
    Some(Unshadowed {
        radiance: scattered * (weight / density),
        wi: sample.wi,
        p_light: sample.p_light,
        kind,
    })
}

/// Whether a point of a light is no farther from the surface that asks than rounding could have put
/// it: a lamp does not light its own back. Rays leave from beyond that error, so the material's
/// samples do not find such light either.
#[inline]
fn is_in_the_surface(ctx: &LightSampleContext, p_light: Vec3) -> bool {
    (p_light - ctx.p).dot(ctx.n).abs() < ctx.n.abs().dot(ctx.p_error)
}
