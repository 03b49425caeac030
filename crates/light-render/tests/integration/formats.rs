//! One scene in four files makes one picture.

use std::path::Path;

use light_render::Comparison;
use light_scene::glam::Vec3;
use light_scene::{Scene, Surface, read_gltf, read_obj, read_pbrt};

use crate::support::{Shot, agree};

fn room(ending: &str) -> Scene {
    let folder =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../light-scene/testdata/three_formats");
    let path = folder.join("room").with_extension(ending);
    let read = match ending {
        "pbrt" => read_pbrt,
        "obj" => read_obj,
        _ => read_gltf,
    };
    read(&path).expect("a scene")
}

fn picture(shot: &Shot, scene: &Scene, seed: u32) -> Vec<Vec3> {
    shot.render(scene, seed).film.develop()
}

#[test]
fn a_scene_looks_the_same_from_every_format() {
    let shot = Shot {
        size: 24,
        spp: 64,
        ..Shot::default()
    };
    let from_pbrt = room("pbrt");
    let mut surfaces = from_pbrt.materials.iter().map(|m| m.surface.clone());
    let conductor = surfaces.find(|surface| matches!(surface, Surface::Conductor { .. }));
    let conductor = conductor.expect("a metal");
    let reference = picture(&shot, &from_pbrt, 0);
    let difference = |pixels: &[Vec3]| Comparison::new(pixels, &reference).expect("same size");
    let noise = difference(&picture(&shot, &from_pbrt, 1)).rel_mse;
    let mean = shot.mean(&from_pbrt);
    for ending in ["obj", "gltf", "glb"] {
        let mut scene = room(ending);
        // An OBJ file has no camera.
        scene.camera = scene.camera.or(from_pbrt.camera);
        // glTF's metals have Schlick's Fresnel factor instead of that of a conductor.
        let metals = scene
            .materials
            .iter_mut()
            .map(|material| &mut material.surface);
        for surface in metals.filter(|surface| matches!(surface, Surface::MetallicRoughness(_))) {
            surface.clone_from(&conductor);
        }
        let found = difference(&picture(&shot, &scene, 2)).rel_mse;
        assert!(
            found < 1.2 * noise,
            "{ending}: relMSE {found}, between two seeds of one file {noise}"
        );
        let (found, error) = shot.mean(&scene);
        assert!(
            agree((found, error), mean),
            "{ending}: mean {found}, of the pbrt file {mean:?}"
        );
    }
}
