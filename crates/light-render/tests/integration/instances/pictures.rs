//! Pictures of instances are those of copies.

use std::path::Path;

use light_scene::glam::{Vec2, Vec3};
use light_scene::{
    Alpha, Color, ColorImage, Files, Image, Material, Scene, Surface as Finish, parse_scene,
};
use lights::media::phase::Isotropic;
use lights::media::{Homogeneous, Region, Substance};
use lights::sources::MediumInterface;
use serde_json::json;

use super::{flattened, green, grove, world};
use crate::support::{Shot, agree};

/// The instances of `scene` look like copies: with the same random numbers no more than one pixel
/// in a hundred differs, where rounding sent a path another way, and the means agree within their
/// noise.
pub(crate) fn assert_looks_flattened(scene: &Scene, what: &str) {
    let shot = Shot {
        size: 32,
        spp: 4,
        ..Shot::default()
    };
    let flat = flattened(scene);
    let [a, b] = [scene, &flat].map(|scene| shot.render(scene, 7).film.develop());
    let differ = |(a, b): &(&Vec3, &Vec3)| a.distance(**b) > 1e-3 * a.max_element();
    let different = a.iter().zip(&b).filter(differ).count();
    assert!(different <= 10, "{what}: {different} of 1024 pixels differ");
    let [a, b] = [scene, &flat].map(|scene| shot.mean(scene));
    assert!(agree(a, b), "{what}: {a:?} and {b:?}");
}

#[test]
fn pictures_are_those_of_copies() {
    assert_looks_flattened(&grove(green()), "matt");
    let glass = Finish::Dielectric {
        eta: 1.5,
        alpha: Vec2::ZERO,
    };
    assert_looks_flattened(&grove(Material::new("glass", glass)), "glass");
    let metal = Finish::Conductor {
        eta: Vec3::splat(0.2),
        k: Vec3::splat(3.0),
        alpha: Vec2::splat(0.2),
    };
    assert_looks_flattened(&grove(Material::new("metal", metal)), "metal");
}

/// A lamp in a room, and three balls on stools.
const STOOLS: &str = r#"
    Scale -1 1 1 LookAt 0 1 4  0 1 0  0 1 0
    Camera "perspective" "float fov" 50
    WorldBegin
    AttributeBegin
        AreaLightSource "diffuse" "rgb L" [ 9 8 7 ] Translate 0 3 0 Rotate 90 1 0 0
        Shape "disk" "float radius" 1
    AttributeEnd
    Shape "trianglemesh" "point3 P" [ -9 0 9  9 0 9  9 0 -9  -9 0 -9 ]
    "integer indices" [ 0 1 2 0 2 3 ]
    ObjectBegin "stool"
        Material "diffuse" "rgb reflectance" [ 0.5 0.3 0.1 ]
        Rotate 90 1 0 0 Shape "cylinder" "float zmin" -1 "float zmax" 0 "float radius" 0.3
        Material "dielectric" Translate 0 0 -1.5 ReverseOrientation Shape "sphere"
        "float radius" 0.4
    ObjectEnd
    ObjectInstance "stool"
    AttributeBegin Translate -1.2 0 0.3 Scale 1 0.5 -0.7 ObjectInstance "stool" AttributeEnd
    Translate 1.2 0 0.3 Rotate 40 0 0.6 0.8 ObjectInstance "stool""#;

#[test]
fn objects_of_pbrt_files_look_flattened() {
    let scene = parse_scene(Path::new("a.pbrt"), STOOLS.as_bytes(), Files::NONE);
    let scene = scene.expect("a scene");
    let world = world(&scene);
    assert_eq!(
        (world.prototype_count(), world.instance_count()),
        (1, 3),
        "stools"
    );
    assert_looks_flattened(&scene, "pbrt");
}

#[test]
fn nodes_of_gltf_files_look_flattened() {
    let folder =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../light-scene/testdata/three_formats");
    let path = folder.join("room.gltf");
    let text = std::fs::read_to_string(&path).expect("it ships");
    let mut document: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let primitive = |positions: u32, material: u32| {
        json!({
            "attributes": {"POSITION": positions, "TEXCOORD_0": 0},
            "indices": 1,
            "material": material,
        })
    };
    // Matt and metal, and what emits light.
    let primitives = [(2, 0), (5, 3), (4, 2)].map(|(p, m)| primitive(p, m));
    let lists = |document: &mut serde_json::Value, list: &str, more: serde_json::Value| {
        document[list].as_array_mut().expect("a list").push(more);
    };
    lists(&mut document, "meshes", json!({"primitives": primitives}));
    let transforms = [
        json!({"mesh": 4, "translation": [0.4, 0.5, 0.0], "scale": [0.2, 0.3, 0.2]}),
        json!({
            "mesh": 4,
            "translation": [-0.6, 1.0, 0.5],
            "scale": [-0.2, 0.1, 0.3],
            "rotation": [0.0, 0.6, 0.0, 0.8],
        }),
        json!({
            "mesh": 4,
            "translation": [0.7, 1.4, 0.5],
            "scale": [0.2, 0.2, 0.2],
            "rotation": [0.36, 0.48, 0.0, 0.8],
        }),
    ];
    for (number, node) in (5..).zip(transforms) {
        lists(&mut document, "nodes", node);
        lists(&mut document["scenes"][0], "nodes", json!(number));
    }
    let text = document.to_string();
    let scene = parse_scene(&path, text.as_bytes(), Files::DISK).expect("a scene");
    let world = world(&scene);
    assert_eq!(
        (world.prototype_count(), world.instance_count()),
        (1, 3),
        "instanced"
    );
    assert_eq!(
        world.stored_triangle_count(),
        8 + 3 * 2 + 4,
        "the emissive part is copied"
    );
    assert_looks_flattened(&scene, "glTF");
}

#[test]
fn textures_and_holes_are_placed_with_their_meshes() {
    let mut scene = grove(green());
    let texels = (0..64).map(|i| Vec3::splat(if i % 3 == 0 { 0.1 } else { 0.9 }));
    let image = Image::new(8, 8, texels.collect()).expect("an image");
    let color = Color::Image(ColorImage::new(scene.add_image(image)));
    let leaves = scene.materials.iter_mut().find(|m| m.name == "leaves");
    let leaves = leaves.expect("the crown's");
    leaves.surface = Finish::Diffuse { reflectance: color };
    assert_looks_flattened(&scene, "textured");
    let leaves = scene.materials.iter_mut().find(|m| m.name == "leaves");
    leaves.expect("the crown's").alpha = Some(Alpha {
        opacity: color,
        cutoff: Some(0.5),
    });
    assert_looks_flattened(&scene, "with an alpha mask");
    assert!(
        scene.materials.iter().any(|m| m.alpha.is_some()),
        "an alpha mask"
    );
}

#[test]
fn media_are_bounded_by_placements() {
    let smoke = Homogeneous {
        substance: Substance::new(Vec3::splat(1.0), Vec3::new(4.0, 8.0, 12.0), Vec3::ZERO)
            .expect("valid"),
        phase: lights::media::Phase::Isotropic(Isotropic),
        region: Region::UNBOUNDED,
    };
    for (what, surface) in [
        ("smoke", Finish::Interface),
        (
            "smoke in glass",
            Finish::Dielectric {
                eta: 1.5,
                alpha: Vec2::ZERO,
            },
        ),
    ] {
        let mut scene = grove(Material::new("leaves", surface));
        let inside = Some(scene.add_medium("smoke", smoke.clone()));
        let leaves = scene.materials.last_mut().expect("the crown's");
        leaves.media = MediumInterface {
            inside,
            outside: None,
        };
        assert_looks_flattened(&scene, what);
    }
}
