use lights::bounds::LightSampleContext;
use lights::glam::Vec2;
use lights::samplers::LightSampler;
use lights::sources::{Light, PdfCoverage};

use crate::World;

/// The exact relative variance of one choice by `sampler` among the lights of `world`: the median
/// over points on the triangles and quadrics of the scene. The contribution of a light is that of
/// its middle without occlusion; 0 means choices in proportion to it. `None` if no point is lit.
#[must_use]
pub(crate) fn choice_variance<S: LightSampler>(world: &World, sampler: &S) -> Option<f64> {
    /// Light evaluations in all, so that the result takes about a second.
    const LOOKS: usize = 2_000_000;
    const POINTS: usize = 64;
    let primitives = world.triangle_count() + world.quadric_count();
    let points = (LOOKS / world.lights().len().max(1)).clamp(1, POINTS);
    let mut variances: Vec<f64> = (0..points.min(primitives))
        .filter_map(|i| {
            let primitive = world.primitive((2 * i + 1) * primitives / (2 * points))?;
            let surface = world.surface(primitive, Vec2::splat(1.0 / 3.0));
            let ctx = world.light_context(&surface, &world.scattering(&surface), surface.n);
            variance_at(world, sampler, &ctx)
        })
        .collect();
    variances.sort_by(f64::total_cmp);
    variances.get(variances.len() / 2).copied()
}

/// `sum f^2 / pmf / (sum f)^2 - 1` over all lights that contribute `f` at `ctx`; `None` where none
/// does.
fn variance_at<S: LightSampler>(
    world: &World,
    sampler: &S,
    ctx: &LightSampleContext,
) -> Option<f64> {
    let (mut sum, mut squares) = (0.0, 0.0);
    for (id, light) in world.lights().iter() {
        let sample = light.sample_li(ctx, Vec2::splat(0.5), &(), PdfCoverage::Complete);
        let Some(li) = sample else { continue };
        let cosine = ctx.ns().map_or(1.0, |ns| li.wi.dot(ns));
        let f = f64::from(li.l.element_sum() * cosine / li.pdf);
        if f > 0.0 {
            sum += f;
            squares += f * f / f64::from(sampler.pmf(ctx, id));
        }
    }
    (sum > 0.0).then(|| (squares / (sum * sum) - 1.0).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AnyLightSampler, SamplerKind};
    use light_scene::BuiltinScene;

    #[test]
    fn a_hierarchy_chooses_better_than_chance() {
        let world = World::new(BuiltinScene::CornellBox.load()).expect("valid");
        let of = |kind| {
            let sampler = AnyLightSampler::new(kind, world.lights()).expect("lights");
            choice_variance(&world, &sampler).expect("lit")
        };
        assert!(
            of(SamplerKind::Bvh) <= of(SamplerKind::Uniform),
            "two triangles of one lamp"
        );
    }
}
