use lights::bounds::LightSampleContext;
use lights::glam::Vec2;
use lights::samplers::LightSampler;
use lights::sources::{Light, LightRef, LightType, PdfCoverage, Rgb};

use crate::World;

/// Light evaluations in all, so that the result takes about a second.
const LOOKS: u32 = 2_000_000;

/// Points on surfaces at most.
const POINTS: u32 = 64;

/// An extended light is sampled at so many points of the unit square, a Fibonacci lattice: each
/// coordinate takes so many values, so that no direction of a sky is preferred.
const SAMPLES: u16 = 21;

/// From a point of the lattice to the next, in the second coordinate.
const LATTICE_STEP: u16 = 13;

/// With more lights than this, one of finite size is sampled at its middle alone.
const FEW_LIGHTS: usize = (LOOKS / POINTS) as usize / SAMPLES as usize;

/// How noisy one choice of a light is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ChoiceVariance {
    /// The relative variance of one choice, the median over points.
    pub(crate) median: f64,
    /// Choices at each point that it is estimated from; `None` where it is exact.
    pub(crate) samples: Option<u32>,
}

/// The relative variance of one choice by `sampler` among the lights of `world`: the median over
/// points on the triangles and quadrics of the scene. The contribution of a light is without
/// occlusion, the mean of some samples where the light is infinite or there are few lights, that of
/// its middle otherwise; 0 means choices in proportion to it. `None` if no point is lit.
///
/// It is exact up to two million lights, and estimated from choices above. The estimate is too low
/// where most of the variance comes from lights that are chosen too rarely to be met, as by power
/// among many lights far away.
#[must_use]
pub(crate) fn choice_variance<S: LightSampler>(
    world: &World,
    sampler: &S,
) -> Option<ChoiceVariance> {
    let lights = world.lights().len();
    match u32::try_from(lights) {
        Ok(lights @ ..=LOOKS) => median(world, LOOKS / lights.max(1), |ctx| {
            exact_at(world, sampler, ctx)
        }),
        _ => estimated(world, sampler),
    }
}

/// The variance as the choices themselves show it.
fn estimated<S: LightSampler>(world: &World, sampler: &S) -> Option<ChoiceVariance> {
    let samples = LOOKS / POINTS;
    let found = median(world, POINTS, |ctx| {
        estimate_at(world, sampler, ctx, samples)
    });
    let samples = Some(samples);
    found.map(|found| ChoiceVariance { samples, ..found })
}

/// The median of `variance_at` over up to `points` points of the scene.
fn median(
    world: &World,
    points: u32,
    variance_at: impl Fn(&LightSampleContext) -> Option<f64>,
) -> Option<ChoiceVariance> {
    let primitives = world.triangle_count() + world.quadric_count();
    let points = points.clamp(1, POINTS) as usize;
    let mut variances: Vec<f64> = (0..points.min(primitives))
        .filter_map(|i| {
            let primitive = world.primitive((2 * i + 1) * primitives / (2 * points))?;
            let surface = world.surface(primitive, Vec2::splat(1.0 / 3.0));
            variance_at(&world.light_context(&surface, &world.scattering(&surface), surface.n))
        })
        .collect();
    variances.sort_by(f64::total_cmp);
    let median = *variances.get(variances.len() / 2)?;
    let samples = None;
    Some(ChoiceVariance { median, samples })
}

/// What a light of `world` contributes at `ctx`; `None` where that is nothing.
fn contribution(world: &World, light: &LightRef<'_, Rgb>, ctx: &LightSampleContext) -> Option<f64> {
    let samples = match light.light_type() {
        LightType::Infinite => SAMPLES,
        LightType::Area if world.lights().len() <= FEW_LIGHTS => SAMPLES,
        _ => 1,
    };
    let place = |i: u16| (f32::from(i % samples) + 0.5) / f32::from(samples);
    let sum: f64 = (0..samples)
        .filter_map(|i| {
            let u = Vec2::new(place(i), place(LATTICE_STEP * i));
            let li = light.sample_li(ctx, u, &(), PdfCoverage::Complete)?;
            let cosine = ctx.ns().map_or(1.0, |ns| li.wi.dot(ns));
            Some(f64::from(li.l.element_sum() * cosine / li.pdf)).filter(|&f| f > 0.0)
        })
        .sum();
    (sum > 0.0).then(|| sum / f64::from(samples))
}

/// `sum f^2 / pmf / (sum f)^2 - 1` over all lights that contribute `f` at `ctx`; `None` where none
/// does.
fn exact_at<S: LightSampler>(world: &World, sampler: &S, ctx: &LightSampleContext) -> Option<f64> {
    let (mut sum, mut squares) = (0.0, 0.0);
    for (id, light) in world.lights().iter() {
        if let Some(f) = contribution(world, &light, ctx) {
            sum += f;
            squares += f * f / f64::from(sampler.pmf(ctx, id));
        }
    }
    (sum > 0.0).then(|| (squares / (sum * sum) - 1.0).max(0.0))
}

/// The same from `samples` choices, which are spread evenly; `None` where none of them contributes.
fn estimate_at<S: LightSampler>(
    world: &World,
    sampler: &S,
    ctx: &LightSampleContext,
    samples: u32,
) -> Option<f64> {
    let step = u64::MAX / u64::from(samples);
    let (mut sum, mut squares) = (0.0, 0.0);
    for i in 0..u64::from(samples) {
        let Some(chosen) = sampler.sample(ctx, i * step + step / 2) else {
            continue;
        };
        let light = world.lights().get(chosen.light);
        if let Some(f) = light.and_then(|light| contribution(world, &light, ctx)) {
            let estimate = f / f64::from(chosen.pmf);
            sum += estimate;
            squares += estimate * estimate;
        }
    }
    (sum > 0.0).then(|| (squares * f64::from(samples) / (sum * sum) - 1.0).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AnyLightSampler, SamplerKind};
    use core::f64::consts::PI;
    use light_scene::{BuiltinScene, Material, Mesh, Scene};
    use lights::glam::Vec3;
    use lights::sources::{
        IntensityAmount, LightDesc, MediumInterface, PointLightDesc, RadianceAmount,
        UniformInfiniteLightDesc,
    };

    #[test]
    fn a_hierarchy_chooses_better_than_chance() {
        let world = World::new(BuiltinScene::Fog.load()).expect("valid");
        let of = |kind| {
            let sampler = AnyLightSampler::new(kind, world.lights()).expect("lights");
            choice_variance(&world, &sampler).expect("lit").median
        };
        let (bvh, uniform) = (of(SamplerKind::Bvh), of(SamplerKind::Uniform));
        assert!(bvh < 0.1 * uniform, "{bvh}, {uniform}: a thousand lamps");
    }

    /// The middle of a sky is at the horizon of a floor.
    #[test]
    fn a_sky_contributes_from_all_its_directions() {
        let mut scene = Scene::default();
        let white = scene.add_material(Material::diffuse("white", Vec3::splat(0.5)));
        let corners = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
        let corners = corners.map(|[x, z]| Vec3::new(x, 0.0, z));
        scene.meshes.push(Mesh::quad("floor", white, corners));
        scene.lights = vec![
            LightDesc::UniformInfinite(UniformInfiniteLightDesc {
                emission: Vec3::ONE,
                amount: RadianceAmount::default(),
            }),
            LightDesc::Point(PointLightDesc {
                position: Vec3::Y * 100.0,
                emission: Vec3::splat(1e4),
                amount: IntensityAmount::default(),
                media: MediumInterface::default(),
            }),
        ];
        let world = World::new(scene).expect("valid");
        let quality = |kind| {
            let sampler = AnyLightSampler::new(kind, world.lights()).expect("lights");
            choice_variance(&world, &sampler).expect("lit").median
        };
        // The irradiance of the sky, and of a point light far above.
        let (sky, point) = (PI, 1.0);
        let expected = 2.0 * (sky * sky + point * point) / (sky + point).powi(2) - 1.0;
        let uniform = quality(SamplerKind::Uniform);
        assert!((uniform - expected).abs() < 0.01, "{uniform}, {expected}");
        let bvh = quality(SamplerKind::Bvh);
        assert!(bvh < uniform, "{bvh}: by what they give");
    }

    #[test]
    fn choices_show_their_variance() {
        let cases = [
            (BuiltinScene::Night, &[SamplerKind::Bvh][..]),
            (
                BuiltinScene::CornellBox,
                &[SamplerKind::Power, SamplerKind::Bvh],
            ),
        ];
        for (scene, kinds) in cases {
            let world = World::new(scene.load()).expect("valid");
            for &kind in kinds {
                let sampler = AnyLightSampler::new(kind, world.lights()).expect("lights");
                let exact = choice_variance(&world, &sampler).expect("lit");
                let estimate = estimated(&world, &sampler).expect("lit");
                assert_eq!(exact.samples, None, "few lights");
                assert!(estimate.samples.is_some(), "an estimate");
                let (exact, estimate) = (exact.median, estimate.median);
                assert!(
                    (estimate - exact).abs() <= 0.05 * exact + 1e-3,
                    "{kind}: {estimate}, {exact}"
                );
            }
        }
    }
}
