//! Spheres, disks and cylinders are round: they are met, lit, and emit light as closed forms say, and
//! as very many triangles do.

mod disks_and_cylinders;
mod hits;
mod parts;
mod pictures;
mod radiance;

use std::path::Path;

use light_render::{World, WorldError};
use light_scene::glam::{Affine3A, Vec2, Vec3};
use light_scene::{Emission, Files, Material, Quadric, Scene, Surface as Finish, parse_scene};

fn similarity(center: Vec3, radius: f32) -> Affine3A {
    let turn = Affine3A::from_axis_angle(Vec3::new(1.0, 2.0, -2.0) / 3.0, 0.9);
    Affine3A::from_translation(center) * turn * Affine3A::from_scale(Vec3::splat(radius))
}

fn add(scene: &mut Scene, material: Material, transform: Affine3A) {
    let material = scene.add_material(material);
    scene
        .quadrics
        .push(Quadric::sphere("ball", material, transform));
}

fn lamp(emission: Emission) -> Material {
    Material {
        emission: Some(emission),
        ..Material::diffuse("lamp", Vec3::splat(0.5))
    }
}

fn glass() -> Finish {
    Finish::Dielectric {
        eta: 1.5,
        alpha: Vec2::ZERO,
    }
}

/// The scene with meshes of many triangles instead of spheres.
fn tessellated(scene: &Scene, columns: u16) -> Scene {
    let mut scene = scene.clone();
    let meshes = scene.quadrics.drain(..).map(|sphere| sphere.mesh(columns));
    scene.meshes.extend(meshes);
    scene
}

fn world(scene: Scene) -> World {
    World::new(scene).expect("a good scene")
}

#[test]
fn spheres_of_pbrt_files_are_round_where_they_can_be() {
    let count = |text: &str| {
        let text = format!("WorldBegin {text}");
        let scene = parse_scene(Path::new("a.pbrt"), text.as_bytes(), Files::NONE);
        let scene = scene.expect("a scene");
        let placed = scene.prototypes.iter().map(|p| p.quadrics.len());
        assert_eq!(scene.instances.len(), scene.prototypes.len(), "{text}");
        let round = scene.quadrics.len() + placed.sum::<usize>();
        assert!(World::new(scene.clone()).is_ok(), "{text}");
        (round, scene.meshes.len())
    };
    let light = "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]";
    let both = format!("{light} \"bool twosided\" true");
    for round in [
        "Shape \"sphere\"".to_owned(),
        "Scale 2 2 -2 Rotate 20 1 2 3 ReverseOrientation Shape \"sphere\" \"float radius\" 3"
            .into(),
        "Shape \"sphere\" \"float zmin\" -1 \"float phimax\" 360 \"float alpha\" .5".into(),
        format!("{light} Material \"interface\" Shape \"sphere\" \"float alpha\" .5"),
        format!("{both} Shape \"sphere\""),
        "Scale 1 2 1 Shape \"sphere\"".into(),
        "Scale 1 2 1 Shape \"cylinder\" \"float phimax\" 90".into(),
        "Shape \"sphere\" \"float zmax\" 0.5".into(),
        "Shape \"sphere\" \"float phimax\" 90".into(),
    ] {
        assert_eq!(count(&round), (1, 0), "{round}");
    }
    for tessellated in [
        format!("{light} Scale 1 2 1 Shape \"sphere\""),
        format!("{light} Shape \"sphere\" \"float zmax\" 0.5"),
        "Shape \"sphere\" \"float zmin\" 0.5 \"float zmax\" 0.5".to_owned(),
        format!("{both} Material \"interface\" Shape \"sphere\""),
        format!("{light} ReverseOrientation Shape \"sphere\" \"float alpha\" .5"),
    ] {
        assert_eq!(count(&tessellated), (0, 1), "{tessellated}");
    }
}

#[test]
fn impossible_spheres_are_refused() {
    let mut scene = Scene::default();
    add(
        &mut scene,
        Material::diffuse("grey", Vec3::ONE),
        Affine3A::from_scale(Vec3::new(1.0, 2.0, 1.0)),
    );
    let error = World::new(scene).err();
    assert_eq!(
        error,
        Some(WorldError::Quadric {
            name: "ball".into()
        }),
        "stretched"
    );
    let text = "WorldBegin\nShape \"sphere\" \"float radius\" -1";
    let error = parse_scene(Path::new("a.pbrt"), text.as_bytes(), Files::NONE).err();
    let error = error.map(|error| error.to_string());
    let expected = "a.pbrt:2: expected `radius` above 0, found -1";
    assert_eq!(error.as_deref(), Some(expected), "inside out");
}
