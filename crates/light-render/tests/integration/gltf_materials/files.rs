//! A file with an image that the reader and the renderer share.

use std::path::PathBuf;

use light_scene::glam::Vec3;
use light_scene::{Camera, Image, Scene, read_scene, write_png};

use crate::gltf_materials::scenes::{add_sky, add_sun, assert_near, direct};

struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        // What is left of a failed test is in the system's folder for such.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A square in the plane y = 0 with a front that looks up, u along +x and (0, 0) of its image in
/// the corner of least x and z.
fn square(folder: &Folder, material: &str) -> Scene {
    let corners: [[f32; 5]; 4] = [
        [-1.0, 0.0, -1.0, 0.0, 0.0],
        [-1.0, 0.0, 1.0, 0.0, 1.0],
        [1.0, 0.0, 1.0, 1.0, 1.0],
        [1.0, 0.0, -1.0, 1.0, 0.0],
    ];
    let bytes: Vec<u8> = corners
        .as_flattened()
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    std::fs::write(folder.0.join("square.bin"), &bytes).expect("written");
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "buffers": [{{"uri": "square.bin", "byteLength": 80}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 80, "byteStride": 20}}],
        "accessors": [
        {{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}},
        {{"bufferView": 0, "byteOffset": 12, "componentType": 5126, "count": 4, "type": "VEC2"}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}},
        "mode": 6, "material": 0}}]}}],
        "textures": [{{"source": 0}}], "images": [{{"uri": "texels.png"}}],
        "materials": [{material}]}}"#
    );
    let path = folder.0.join("square.gltf");
    std::fs::write(&path, json).expect("written");
    let scene = read_scene(&path).expect("a scene");
    assert_eq!(scene.warnings, [], "all understood");
    scene
}

/// The left half mirrors and the right half is matt; the texture transform of the second file
/// swaps both.
#[test]
fn a_file_whose_image_holds_a_mirror_and_paint() {
    let folder = Folder(std::env::temp_dir().join(format!("lights_pbr_{}", std::process::id())));
    std::fs::create_dir_all(&folder.0).expect("a folder");
    let (mirror, matt) = (Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.0, 1.0, 0.0));
    let texels = [mirror, mirror, matt, matt].repeat(2);
    let image = Image::new(4, 2, texels).expect("an image");
    write_png(&folder.0.join("texels.png"), &image).expect("written");
    for (transform, swapped) in [("", false), (r#""offset": [0.5, 0]"#, true)] {
        let scene = square(
            &folder,
            &format!(
                r#"{{"pbrMetallicRoughness": {{"baseColorFactor": [0.6, 0.6, 0.6, 1],
                "metallicRoughnessTexture": {{"index": 0,
                "extensions": {{"KHR_texture_transform": {{{transform}}}}}}}}},
                "extensions": {{"KHR_materials_specular": {{"specularFactor": 0}}}}}}"#
            ),
        );
        for x in [-0.5f32, 0.5] {
            let mut scene = scene.clone();
            let place = Vec3::new(x, 0.0, 0.0);
            scene.camera = Camera::look_at(place + Vec3::Y, place, Vec3::Z, 1e-3).ok();
            add_sky(&mut scene);
            add_sun(&mut scene, Vec3::new(0.0, 0.8, 0.6));
            let is_matt = (x > 0.0) != swapped;
            let sun = if is_matt {
                0.8 / core::f64::consts::PI
            } else {
                0.0
            };
            let what = format!("at {x}, swapped {swapped}");
            assert_near(direct(&scene), 0.6 * (1.0 + sun), &what);
        }
    }
}
