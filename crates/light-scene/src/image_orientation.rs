//! Tests of the orientation of images: the same picture, each quarter of another brightness, on a
//! wall in every format, and as an environment map.

use core::f32::consts::PI;
use std::path::Path;

use lights::sources::{ImageInfiniteLight, InfiniteLight, LightDesc, Rgb, SceneSphere};

use crate::glam::{Affine3A, Vec2, Vec3};
use crate::gltf::parse_gltf;
use crate::image::tests::png;
use crate::pbrt::parse_pbrt;
use crate::{Color, Diagnostic, Files, Image, Scene, Surface, parse_obj};

/// Levels of the upper left, upper right, lower left and lower right quarter.
const LEVELS: [u8; 4] = [60, 120, 180, 240];

/// What a file beside a scene holds.
fn read_sibling(path: &Path) -> Result<Vec<u8>, Diagnostic> {
    match path.to_str() {
        Some("a.png") => {
            let picture = image::GrayImage::from_raw(2, 2, LEVELS.to_vec());
            Ok(png(picture.expect("four texels")))
        }
        Some("a.mtl") => Ok(b"newmtl a\nKd 1 1 1\nmap_Kd a.png\nKe 1 1 1\nmap_Ke a.png\n".to_vec()),
        Some("a.bin") => {
            let positions = [
                0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0,
            ];
            let uvs = [0.0f32, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
            let floats = [&positions[..], &uvs].concat();
            Ok(floats.into_iter().flat_map(f32::to_le_bytes).collect())
        }
        _ => Err(Diagnostic::file(path, "cannot be read")),
    }
}

/// The wall's quarters as the picture's numbers: of each, the level where the corner's texture
/// coordinates say.
fn assert_upright(scene: &Scene, format: &str) {
    let mesh = &scene.meshes[0];
    let uvs = mesh.uvs.as_ref().expect("texture coordinates");
    let middle = uvs.iter().sum::<Vec2>() / uvs.len() as f32;
    let material = scene.material(mesh.material);
    let reflectance = match &material.surface {
        Surface::Diffuse { reflectance } => *reflectance,
        Surface::MetallicRoughness(surface) => surface.base_color,
        _ => panic!("{format}: a matt surface"),
    };
    for color in [material.emission.expect("a lamp").radiance, reflectance] {
        let Color::Image(shown) = color else {
            panic!("{format}: an image");
        };
        let image = scene.images[shown.image.0 as usize].to_light();
        let image = image.expect("light");
        assert_eq!(mesh.positions.len(), 4, "{format}: four corners");
        for (p, &uv) in mesh.positions.iter().zip(uvs) {
            let level = match (p.x > 0.5, p.y > 0.5) {
                (false, true) => LEVELS[0],
                (true, true) => LEVELS[1],
                (false, false) => LEVELS[2],
                (true, false) => LEVELS[3],
            };
            let expected = ((f32::from(level) / 255.0 + 0.055) / 1.055).powf(2.4);
            let found = image.on_surface(middle.lerp(uv, 0.5), &shown.mapping).y;
            assert!(
                (found - expected).abs() < 1e-3,
                "{format}, {p}: {found}, not {expected}"
            );
        }
    }
}

#[test]
fn pictures_stand_upright_in_every_format() {
    let files = Files::new(&read_sibling);
    let obj = "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\
        vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    assert_upright(
        &parse_obj(Path::new("a.obj"), obj, files).expect("a scene"),
        "obj",
    );
    let pbrt = "WorldBegin Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\"
        Material \"diffuse\" \"texture reflectance\" \"t\"
        AreaLightSource \"diffuse\" \"string filename\" \"a.png\"
        Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  1 1 0  0 1 0] \"integer indices\" \
        [0 1 2 0 2 3]
        \"point2 uv\" [0 0  1 0  1 1  0 1]";
    assert_upright(
        &parse_pbrt(Path::new("a"), pbrt, files).expect("a scene"),
        "pbrt",
    );
    // The upper left corner of an image has the texture coordinates (0, 0).
    let gltf =
        br#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "buffers": [{"uri": "a.bin", "byteLength": 80}],
        "bufferViews": [{"buffer": 0, "byteLength": 48},
        {"buffer": 0, "byteOffset": 48, "byteLength": 32}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4},
            {"bufferView": 1, "componentType": 5126, "type": "VEC2", "count": 4}],
        "images": [{"uri": "a.png"}], "textures": [{"source": 0}],
        "materials": [{"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0},
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 683.002}},
            "pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": 0}}}],
        "meshes": [{"primitives": [{"mode": 6, "material": 0, "attributes": {"POSITION": 0,
        "TEXCOORD_0": 1}}]}]}"#;
    assert_upright(
        &parse_gltf(Path::new("a.gltf"), gltf, files).expect("a scene"),
        "gltf",
    );
}

/// Columns of a lat-long map run to the right, as seen from within, and its middle is +z: its left
/// half is at +x.
#[test]
fn skies_around_a_scene_are_upright() {
    const SIDE: u32 = 32;
    let block = |x: u32, y: u32| Vec3::splat((1 + x / SIDE + 4 * (y / SIDE)) as f32);
    let texels = (0..2 * SIDE).flat_map(|y| (0..4 * SIDE).map(move |x| block(x, y)));
    let map = Image::new(4 * SIDE, 2 * SIDE, texels.collect()).expect("an image");
    let mut scene = Scene::default();
    scene.add_sky(&map, Affine3A::IDENTITY).expect("a sky");
    let LightDesc::ImageInfinite(desc) = scene.lights[0].clone() else {
        panic!("a map");
    };
    let around = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
    let light = ImageInfiniteLight::<Rgb>::new(desc, around).expect("a light");
    for (column, row) in (0..8u8).map(|k| (f32::from(k % 4), f32::from(k / 4))) {
        let up = if row == 0.0 { 0.5 } else { -0.5 };
        // Clockwise from above, from the back of the map's middle on.
        let around = 0.5 * PI * (column + 0.5);
        let w = Vec3::new(around.sin(), up, -around.cos()).normalize();
        let found = light.le(Vec3::ZERO, w, &()).y;
        let expected = 1.0 + column + 4.0 * row;
        assert!(
            (found - expected).abs() < 1e-2,
            "{w}: {found}, not {expected}"
        );
    }
}
