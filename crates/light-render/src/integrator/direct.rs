use lights::bounds::{LightId, LightSampleContext};
use lights::glam::Vec3;
use lights::samplers::LightSampler;
use lights::sources::Light;

use super::{Estimator, Traced};
use crate::bsdf::Scattering;
use crate::sample_stream::VertexNumbers;
use crate::{Surface, World};

/// The light that one sample of one light sends over `surface` toward `wo`.
#[inline]
#[expect(
    clippy::too_many_arguments,
    reason = "the state of the path, which has no other home"
)]
pub(super) fn from_lights<S: LightSampler>(
    world: &World,
    sampler: &S,
    estimator: Estimator,
    surface: &Surface,
    scattering: &Scattering,
    ctx: &LightSampleContext,
    wo: Vec3,
    numbers: &VertexNumbers,
) -> Traced {
    let nothing = Traced::default();
    let Some(choice) = sampler.sample(ctx, numbers.light) else {
        return nothing;
    };
    let Some(light) = world.lights().get(choice.light) else {
        return nothing;
    };
    let coverage = estimator.coverage();
    let Some(sample) = light.sample_li(ctx, numbers.light_point, &(), coverage) else {
        return nothing;
    };
    let scattered = scattering.eval(wo, sample.wi) * sample.l;
    if scattered == Vec3::ZERO {
        return nothing;
    }
    if world.occluded(surface, sample.wi, sample.p_light) {
        return Traced { rays: 1, ..nothing };
    }
    let density = choice.pmf * sample.pdf;
    let weight = if light.light_type().is_delta() {
        1.0
    } else {
        estimator.light_weight(density, scattering.pdf(wo, sample.wi))
    };
    Traced {
        radiance: scattered * (weight / density),
        rays: 1,
    }
}

/// The density in sr^-1 with which [`from_lights`] samples the direction `wi` toward `light`.
#[inline]
pub(super) fn light_density<S: LightSampler>(
    world: &World,
    sampler: &S,
    estimator: Estimator,
    ctx: &LightSampleContext,
    light: LightId,
    wi: Vec3,
) -> f32 {
    let Some(source) = world.lights().get(light) else {
        return 0.0;
    };
    let pmf = sampler.pmf(ctx, light);
    if pmf > 0.0 {
        pmf * source.pdf_li(ctx, wi, estimator.coverage())
    } else {
        0.0
    }
}
