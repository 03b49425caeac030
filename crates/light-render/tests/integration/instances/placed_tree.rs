//! Lights of instances are chosen by a tree of placed trees as by a flat tree.

use core::ops::Range;

use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{AnyLightSampler, Film, RenderSettings, SamplerKind, View, World, render};
use light_scene::glam::{Affine3A, DVec3, Quat, Vec2, Vec3};
use light_scene::{Emission, Instance, Material, Prototype, Scene};
use lights::bounds::{LightId, LightSampleContext};
use lights::samplers::LightSampler;
use lights::sources::{DistantLightDesc, PointLightDesc};
use lights::sources::{
    IntensityAmount, IrradianceAmount, Light, LightDesc, MediumInterface, PdfCoverage,
};

use super::{ball, block, green, transforms, world};
use crate::support::cornell;

/// Two kinds of lamp in turned, scaled and mirrored places, some of them skewed, with a sun and a
/// point light among the lights that are not placed.
fn street() -> Scene {
    let mut scene = cornell();
    let mut shining = |emission| {
        scene.add_material(Material {
            emission: Some(emission),
            ..green()
        })
    };
    let warm = shining(Emission::one_sided(Vec3::new(2.0, 1.5, 0.5)));
    let cold = shining(Emission::two_sided(Vec3::new(0.2, 0.3, 0.6)));
    let lantern = Prototype::new("lantern", vec![ball(warm, 4), ball(cold, 6)]);
    let sign = Prototype::new("sign", vec![block(cold)]);
    let [lantern, sign] = [lantern, sign].map(|object| scene.add_prototype(object));
    let turned = (0..30u8).map(|i| {
        let x = f32::from(i);
        let turn = Quat::from_axis_angle(Vec3::new(2.0, -1.0, 2.0) / 3.0, x);
        let side = if i % 3 == 0 { -1.0 } else { 1.0 };
        let scale = Vec3::splat(side * (0.01 + 0.001 * x));
        let at = Vec3::new(0.37, 0.61, 0.83) * x;
        let at = at.fract() * 0.8 + Vec3::splat(0.1);
        Affine3A::from_scale_rotation_translation(scale, turn, at)
    });
    for (i, transform) in turned.chain(transforms()).enumerate() {
        scene.instances.push(Instance {
            prototype: if i % 2 == 0 { lantern } else { sign },
            transform,
        });
    }
    scene.lights.push(LightDesc::Distant(DistantLightDesc {
        direction: Vec3::new(0.0, 0.6, -0.8),
        emission: Vec3::ONE,
        amount: IrradianceAmount::Radiometric(1.0),
    }));
    scene.lights.push(LightDesc::Point(PointLightDesc {
        position: Vec3::splat(0.5),
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(0.1),
        media: MediumInterface::default(),
    }));
    scene
}

fn placed(world: &World) -> AnyLightSampler {
    let sampler = AnyLightSampler::placed(world.lights()).expect("valid lights");
    assert!(matches!(sampler, AnyLightSampler::BvhPlaced(_)), "placed");
    sampler
}

/// Points on surfaces, looking along their normals.
fn contexts(world: &World) -> Vec<LightSampleContext> {
    let count = world.triangle_count();
    let primitive = |i: usize| world.primitive(i * count / 40).expect("there");
    let on = |i| world.surface(primitive(i), Vec2::new(0.3, 0.3));
    (0..40)
        .map(on)
        .map(|surface| LightSampleContext::surface(surface.p, surface.n, surface.n))
        .collect()
}

#[test]
fn probabilities_are_those_of_samples_and_no_light_is_lost() {
    let world = world(&street());
    let (lights, sampler) = (world.lights(), placed(&world));
    let ids = || (0..).map(LightId).take(lights.len());
    let mut contributing = 0;
    for ctx in contexts(&world) {
        let mut none = 0;
        for i in 0..400u64 {
            let u = i.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let Some(sample) = sampler.sample(&ctx, u) else {
                none += 1;
                continue;
            };
            let pmf = sampler.pmf(&ctx, sample.light);
            assert_eq!(sample.pmf.to_bits(), pmf.to_bits(), "{:?}", sample.light);
            let here = sampler.at(&ctx, 2);
            assert_eq!(here.pmf(sample.light).to_bits(), pmf.to_bits(), "at once");
        }
        let sum: f64 = ids().map(|id| f64::from(sampler.pmf(&ctx, id))).sum();
        assert!(sum < 1.0 + 1e-4, "{sum} at {ctx:?}");
        let missing = f64::from(none) / 400.0;
        assert!((sum + missing - 1.0).abs() < 0.13, "{sum} and {missing}");
        for (id, light) in lights.iter() {
            let li = light.sample_li(&ctx, Vec2::splat(0.4), &(), PdfCoverage::Complete);
            let cosine = |wi: Vec3| ctx.ns().map_or(0.0, |n| n.dot(wi));
            if li.is_some_and(|li| li.l != Vec3::ZERO && cosine(li.wi) > 0.0) {
                contributing += 1;
                assert!(sampler.pmf(&ctx, id) > 0.0, "{id:?} at {ctx:?}");
            }
        }
    }
    assert!(contributing > 10_000, "{contributing} pairs");
    let unknown = LightId(u32::try_from(lights.len()).expect("few"));
    assert_eq!(sampler.pmf(&contexts(&world)[0], unknown), 0.0, "unknown");
    let emitted: f64 = ids().map(|id| f64::from(sampler.pmf_emitter(id))).sum();
    assert!((emitted - 1.0).abs() < 1e-3, "{emitted} over all emitters");
}

/// The picture of `world` by so many samples of a sampler.
fn film(
    (scene, world): (&Scene, &World),
    sampler: &AnyLightSampler,
    samples: Range<u32>,
    seed: u32,
) -> Film {
    let view = View::new(&scene.camera_or_default(), 16, 16).expect("a view");
    let settings = RenderSettings {
        samples,
        time_limit: None,
        seed,
        path: PathSettings {
            max_depth: 4,
            estimator: Estimator::Mis,
            light_samples: core::num::NonZeroU32::MIN,
            integrator: Integrator::fitting(world),
        },
    };
    let rendering = render(world, &view, sampler, &settings, |_| ());
    assert_eq!(rendering.rejected, 0, "every sample is finite");
    rendering.film
}

/// The same seeds, with either tree: the mean difference is within three of its standard errors.
#[test]
fn pictures_are_those_of_a_flat_tree() {
    const RUNS: u32 = 16;
    let scene = street();
    let world = world(&scene);
    let placed = placed(&world);
    let flat = AnyLightSampler::new(SamplerKind::Bvh, world.lights()).expect("lights");
    assert!(matches!(flat, AnyLightSampler::Bvh(_)), "few lights: flat");
    let difference = |seed| {
        let [a, b] = [&placed, &flat].map(|sampler| {
            let pixels = film((&scene, &world), sampler, 0..16, seed).develop();
            pixels.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / pixels.len() as f64
        });
        (a - b) / b
    };
    let all: Vec<DVec3> = (0..RUNS).map(difference).collect();
    let mean = all.iter().sum::<DVec3>() / f64::from(RUNS);
    let squares = all.iter().map(|d| (d - mean) * (d - mean)).sum::<DVec3>();
    let error = (squares / f64::from(RUNS * (RUNS - 1))).map(f64::sqrt);
    assert!(error.max_element() < 0.02, "precise enough: {error}");
    assert!(mean.abs().cmple(error * 3.0).all(), "{mean} +- {error}");
}

#[test]
fn threads_and_parts_do_not_change_a_bit_of_placed_choices() {
    let scene = street();
    let on = |threads, samples: Range<u32>| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(|| {
            let world = world(&scene);
            film((&scene, &world), &placed(&world), samples, 3)
        })
    };
    let whole = on(1, 0..6).develop();
    for threads in [2, 7] {
        assert!(on(threads, 0..6).develop() == whole, "{threads} threads");
    }
    let mut merged = on(2, 2..4);
    merged.add(&on(1, 0..2));
    merged.add(&on(7, 4..6));
    assert!(merged.develop() == whole, "three parts");
}

/// From a million placed lights on the default hierarchy is a tree of placed trees.
#[test]
fn a_million_placed_lights_take_the_memory_of_their_places() {
    let sampler = |count: u32| {
        let mut scene = Scene::default();
        let lamp = scene.add_material(Material {
            emission: Some(Emission::one_sided(Vec3::ONE)),
            ..green()
        });
        let lamp = Prototype::new("lamp", vec![ball(lamp, 16)]);
        let own = u32::try_from(lamp.triangle_count()).expect("few");
        let prototype = scene.add_prototype(lamp);
        scene.instances.extend((0..count.div_ceil(own)).map(|i| {
            let at = Vec3::new((i % 100) as f32, 0.0, (i / 100) as f32) * 3.0;
            let transform = Affine3A::from_translation(at);
            Instance {
                prototype,
                transform,
            }
        }));
        let world = world(&scene);
        let sampler = AnyLightSampler::new(SamplerKind::Bvh, world.lights()).expect("lights");
        let bytes = sampler.bytes(world.lights().len());
        let lights = world.lights().len();
        assert!(lights >= count as usize, "{lights} lights");
        (sampler, bytes as f64 / lights as f64)
    };
    let (many, bytes) = sampler(1 << 20);
    assert!(matches!(many, AnyLightSampler::BvhPlaced(_)), "a million");
    assert!(bytes < 1.0, "{bytes} bytes a light");
    let (fewer, bytes) = sampler(1 << 19);
    assert!(matches!(fewer, AnyLightSampler::Bvh(_)), "half a million");
    assert!(bytes > 20.0, "{bytes} bytes a light");
}
