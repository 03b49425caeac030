//! The scenes in which most lights are hidden: lamps are free, their light is found, and no way to
//! choose them loses any.

use light_render::bench::{ChoiceKind, scene_variance};
use light_render::lights::bounds::LightSampleContext;
use light_render::lights::glam::Vec3;
use light_render::lights::samplers::LightSampler;
use light_render::{AnyLightSampler, Ray, SamplerKind, View, World};
use light_scene::{OcclusionKind, OcclusionScene, Scene};

fn scene(kind: OcclusionKind, lamps: u32, seed: u64) -> Scene {
    OcclusionScene { kind, lamps, seed }.load()
}

/// Centroids and front normals of all emissive triangles.
fn lamps(scene: &Scene) -> Vec<[Vec3; 2]> {
    let meshes = scene.meshes.iter();
    let emissive = meshes.filter(|mesh| scene.is_emissive(mesh.material));
    let triangles = emissive.flat_map(|mesh| (0..mesh.indices.len()).map(|i| mesh.triangle(i)));
    let front = |[a, b, c]: [Vec3; 3]| [(a + b + c) / 3.0, (b - a).cross(c - a).normalize()];
    triangles.map(front).collect()
}

#[test]
fn the_space_before_each_lamp_is_free() {
    const FREE: f32 = 0.05;
    for kind in OcclusionKind::ALL {
        for (lamps_asked, seed) in [(100, 1), (100, 2), (2_000, 1)] {
            let scene = scene(kind, lamps_asked, seed);
            let lamps = lamps(&scene);
            let world = World::new(scene).expect("valid");
            for [p, n] in lamps {
                let ray = Ray {
                    origin: p + n * 1e-4,
                    direction: n,
                };
                let blocked = world.closest(&ray, None).map(|hit| hit.p.distance(p));
                let distance = blocked.unwrap_or(f32::INFINITY);
                assert!(distance > FREE, "{kind} {seed}: {distance} before {p}");
            }
        }
    }
}

/// Most light is hidden but in the open, every sampler reaches all that arrives, and the parts are
/// in order.
#[test]
fn light_is_hidden_and_none_is_lost() {
    for kind in OcclusionKind::ALL {
        let scene = scene(kind, 100, 1);
        let view = View::new(&scene.camera_or_default(), 6, 4).expect("a small picture");
        let world = World::new(scene).expect("valid");
        let variance = scene_variance(&world, &view, 2, 1).expect("lights");
        assert!(variance.receivers >= 12, "{kind}: {}", variance.receivers);
        let is_open = kind == OcclusionKind::Open;
        let share = variance.arriving;
        assert_eq!(share > 0.85, is_open, "{kind}: {share} arrives");
        let of = |choice| {
            let row = variance.rows.iter().find(|(kind, _)| *kind == choice);
            row.expect("every kind has a row").1
        };
        let best = of(ChoiceKind::Best);
        for (choice, row) in &variance.rows {
            assert_eq!(row.lost, 0.0, "{kind}: {choice:?}");
            let sum = row.between + row.within;
            let least = (best.between + best.within) * (1.0 - 1e-9);
            assert!(sum >= least, "{kind}: {choice:?} {sum} against {least}");
        }
    }
}

/// A light chosen by any hierarchy has the pmf that a query says, and the pmfs add up.
#[test]
fn choices_in_the_scenes_obey_the_laws() {
    for kind in OcclusionKind::ALL {
        let scene = scene(kind, 300, 3);
        let eye = scene.camera_or_default().position;
        let world = World::new(scene).expect("valid");
        let ctx = LightSampleContext::surface(eye - Vec3::Y, Vec3::Y, Vec3::Y);
        for sampler in [SamplerKind::Bvh, SamplerKind::BvhReference] {
            let sampler = AnyLightSampler::new(sampler, world.lights()).expect("lights");
            let all = world.lights().iter();
            let sum: f64 = all.map(|(id, _)| f64::from(sampler.pmf(&ctx, id))).sum();
            assert!(sum <= 1.0 + 1e-5, "{kind}: {sum}");
            for k in 0..64 {
                let u = (2 * k + 1) << 57;
                if let Some(choice) = sampler.sample(&ctx, u) {
                    let pmf = sampler.pmf(&ctx, choice.light);
                    assert_eq!(choice.pmf.to_bits(), pmf.to_bits(), "{kind}: same bits");
                }
            }
        }
    }
}
