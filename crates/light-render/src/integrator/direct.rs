use lights::bounds::{LightId, LightSampleContext, SampledLight};
use lights::glam::{Vec2, Vec3};
use lights::math::distribution::WeightedReservoir;
use lights::samplers::LightSampler;
use lights::sources::Light;

use super::{Estimator, Traced};
use crate::bsdf::Scattering;
use crate::{SampleStream, Surface, World};

/// How a vertex of a path asks for light: kept until the next ray is known to miss or to find a light, because both strategies weigh
/// their samples by the same densities.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightQuestion {
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
}

/// Where light is asked for: a point of a surface, what it is made of, and who looks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex<'a> {
    pub(super) surface: &'a Surface,
    pub(super) scattering: &'a Scattering,
    pub(super) wo: Vec3,
    /// Its number along the path, from 0 on.
    pub(super) number: u32,
}

/// What a light sends over a vertex if nothing is in the way.
#[derive(Clone, Copy, Debug)]
struct Unshadowed {
    radiance: Vec3,
    wi: Vec3,
    p_light: Vec3,
}

impl<S: LightSampler> DirectLight<'_, S> {
    /// The light that as many light samples as `question` says send over `vertex` toward its viewer, with one shadow ray for all of
    /// them: an unbiased estimate that costs little more than that of a single light.
    ///
    /// `u` chooses the lights, `u_shadow` the one whose shadow counts for all; both are in `[0, 1)`.
    #[inline]
    pub(super) fn sample(
        &self,
        question: &LightQuestion,
        vertex: &Vertex<'_>,
        u: f64,
        u_shadow: f32,
        stream: &SampleStream,
    ) -> Traced {
        let LightQuestion { ctx, count } = question;
        // The more a candidate would give, the more likely it is the one whose shadow is looked at.
        let mut candidates = WeightedReservoir::new(u_shadow.into());
        let mut number = 0;
        let mut each = |choice| {
            let point = stream.light_point(vertex.number, number, *count);
            number += 1;
            if let Some(candidate) = self.unshadowed(question, vertex, choice, point) {
                candidates.add(candidate, candidate.radiance.element_sum());
            }
        };
        if *count == 1 {
            // A single choice does not pay for a closer look at all lights.
            self.sampler.sample(ctx, u).map(&mut each);
        } else {
            self.sampler.sample_many(ctx, u, *count, &mut each);
        }
        let Some(chosen) = candidates.sample() else {
            return Traced::default();
        };
        let Unshadowed {
            radiance,
            wi,
            p_light,
        } = chosen.value;
        let shadowed = self.world.occluded(vertex.surface, wi, p_light);
        Traced {
            radiance: if shadowed {
                Vec3::ZERO
            } else {
                radiance / chosen.pmf
            },
            rays: 1,
        }
    }

    /// The share that one chosen light has in [`sample`](Self::sample) if nothing is in the way; `None` if it has none.
    #[inline]
    fn unshadowed(
        &self,
        question: &LightQuestion,
        vertex: &Vertex<'_>,
        choice: SampledLight,
        u_point: Vec2,
    ) -> Option<Unshadowed> {
        let Vertex { scattering, wo, .. } = *vertex;
        let light = self.world.lights().get(choice.light)?;
        let coverage = self.estimator.coverage();
        let sample = light.sample_li(&question.ctx, u_point, &(), coverage)?;
        let scattered = scattering.eval(wo, sample.wi) * sample.l;
        if scattered == Vec3::ZERO {
            return None;
        }
        let density = question.count as f32 * choice.pmf * sample.pdf;
        let weight = if light.light_type().is_delta() {
            1.0
        } else {
            self.estimator
                .light_weight(density, scattering.pdf(wo, sample.wi))
        };
        Some(Unshadowed {
            radiance: scattered * (weight / density),
            wi: sample.wi,
            p_light: sample.p_light,
        })
    }

    /// The expected number of samples per sr that [`sample`](Self::sample) takes in the direction `wi` toward `light`.
    #[inline]
    pub(super) fn density(&self, question: &LightQuestion, light: LightId, wi: Vec3) -> f32 {
        let LightQuestion { ctx, count } = question;
        let Some(source) = self.world.lights().get(light) else {
            return 0.0;
        };
        let pmf = if *count == 1 {
            self.sampler.pmf(ctx, light)
        } else {
            *count as f32 * self.sampler.pmf_many(ctx, light)
        };
        if pmf > 0.0 {
            pmf * source.pdf_li(ctx, wi, self.estimator.coverage())
        } else {
            0.0
        }
    }
}
