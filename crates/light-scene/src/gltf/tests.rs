use std::path::Path;

use super::data_uri::tests::data_uri;
use super::glb::tests::glb;
use super::parse_gltf;
use crate::glam::{Affine3A, Vec2, Vec3};
use crate::{Color, EmissionSides, Files, Scene, Surface};

/// A square of four vertices in z = 0 and its two triangles as bytes: positions, texture
/// coordinates, indices.
fn square() -> Vec<u8> {
    let corners = [[0.0f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut bytes = Vec::new();
    for [x, y] in corners {
        bytes.extend([x, y, 0.0].map(f32::to_le_bytes).concat());
    }
    for [x, y] in corners {
        bytes.extend([x, 1.0 - y].map(f32::to_le_bytes).concat());
    }
    bytes.extend([0u16, 1, 2, 0, 2, 3].map(u16::to_le_bytes).concat());
    bytes
}

/// Buffer, views and accessors of [`square`], before a comma.
const SQUARE: &str = r#""asset": {"version": "2.0"},
    "bufferViews": [{"buffer": 0, "byteLength": 48},
    {"buffer": 0, "byteOffset": 48, "byteLength": 32},
        {"buffer": 0, "byteOffset": 80, "byteLength": 12}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
    "max": [1, 1, 0]},
        {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
        {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "buffers": [{"byteLength": 92 $URI}],"#;

pub(super) fn head() -> String {
    SQUARE.replace("$URI", &format!(r#", "uri": "{}""#, data_uri(&square())))
}

pub(super) fn read(json: &str) -> Result<Scene, String> {
    let json = format!("{{{} {json}}}", head());
    let scene = parse_gltf(Path::new("a.gltf"), json.as_bytes(), Files::NONE);
    scene.map_err(|error| error.to_string())
}

const LAMP: &str = r#""scene": 0, "scenes": [{"nodes": [0, 2]}],
    "nodes": [{"translation": [0, 2, 0], "scale": [2, 2, 2], "children": [1]},
    {"mesh": 0, "skin": 0},
        {"translation": [0, 0, 5], "camera": 0}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 1.5,
    "znear": 0.1}}],
    "meshes": [{"name": "lamp", "primitives": [
        {"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "COLOR_0": 0}, "indices": 2, "material": 0},
        {"attributes": {"POSITION": 0}, "mode": 1}]}],
    "materials": [{"name": "glow", "emissiveFactor": [1, 0.5, 0], "doubleSided": true,
        "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 1], "metallicFactor": 0},
        "occlusionTexture": {"index": 0},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1366},
        "X_glitter": {}}}]"#;

#[test]
fn reads_nodes_meshes_materials_and_a_camera() {
    let scene = read(LAMP).expect("a scene");
    let [mesh] = &scene.meshes[..] else {
        panic!("one mesh, not {}", scene.meshes.len());
    };
    assert_eq!(mesh.name, "lamp", "its name");
    let moved = [[0.0, 2.0], [2.0, 2.0], [2.0, 4.0], [0.0, 4.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    assert_eq!(mesh.positions, moved, "scaled, then moved");
    assert_eq!(mesh.indices, [[0, 1, 2], [0, 2, 3]], "triangles");
    let uvs = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    assert_eq!(
        mesh.uvs.as_deref(),
        Some(&uvs[..]),
        "(0, 0) is the lower left corner"
    );
    let material = scene.material(mesh.material);
    let emission = material.emission.expect("it is emissive");
    let radiance = Color::Constant(Vec3::new(2.0, 1.0, 0.0));
    assert_eq!(
        emission.radiance, radiance,
        "1366 nits of white are 2 W m^-2 sr^-1"
    );
    assert_eq!(emission.sides, EmissionSides::Both, "double-sided");
    let Surface::MetallicRoughness(surface) = &material.surface else {
        panic!("a coat, not {:?}", material.surface);
    };
    let color = Color::Constant(Vec3::new(0.1, 0.2, 0.3));
    assert_eq!(surface.base_color, color, "the base");
    let rough = Color::Constant(Vec3::new(1.0, 1.0, 0.0));
    assert_eq!(surface.roughness_metallic, rough, "rough, and no metal");
    assert!(
        surface.f0.abs_diff_eq(Vec3::splat(0.04), 1e-6),
        "index 1.5: {}",
        surface.f0
    );
    assert_eq!(mesh.colors.as_deref().map(<[_]>::len), Some(4), "colours");
    let camera = scene.camera.expect("a camera");
    assert_eq!(camera.position, Vec3::Z * 5.0, "its position");
    assert_eq!(
        (camera.forward, camera.right),
        (Vec3::NEG_Z, Vec3::X),
        "where it looks"
    );
    assert!(
        (camera.fov - 0.5).abs() < 1e-6,
        "of the shorter side: {}",
        camera.fov
    );
    let warnings: Vec<_> = scene.warnings.iter().map(|w| w.message.as_str()).collect();
    let expected = [
        "meshes[0].primitives[1]: was left out: it has no triangles",
        "materials[0].extensions.X_glitter: was ignored",
        "nodes[1].skin: was ignored",
    ];
    let mut warnings = warnings;
    warnings.sort_unstable();
    assert_eq!(
        warnings.len(),
        expected.len() + 1,
        "and the attributes of the lines: {warnings:?}"
    );
    for message in expected {
        assert!(warnings.contains(&message), "{message} in {warnings:?}");
    }
}

#[test]
fn meshes_of_several_nodes_are_instanced() {
    let json = r#""scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [{"mesh": 0, "scale": [2, 1, 1], "children": [3]}, {"mesh": 1}, {"mesh": 0},
            {"mesh": 0, "translation": [1, 0, 0]}],
        "meshes": [{"name": "square", "primitives": [{"attributes": {"POSITION": 0},
        "indices": 2}]},
            {"primitives": [{"attributes": {"POSITION": 0}, "indices": 2}]}]"#;
    let scene = read(json).expect("a scene");
    assert_eq!(scene.meshes.len(), 1, "one node shows the second");
    let [square] = &scene.prototypes[..] else {
        panic!("one, not {}", scene.prototypes.len());
    };
    assert_eq!(square.name, "square", "its name");
    assert_eq!(square.meshes[0].positions[1], Vec3::X, "in object space");
    let transforms: Vec<_> = scene.instances.iter().map(|i| i.transform).collect();
    let wide = Affine3A::from_scale(Vec3::new(2.0, 1.0, 1.0));
    let moved = wide * Affine3A::from_translation(Vec3::X);
    assert_eq!(transforms, [wide, moved, Affine3A::IDENTITY], "three nodes");
    assert_eq!(scene.triangle_count(), 8, "four squares");
    let far = json.replace("[1, 0, 0]", "[3e38, 0, 0]");
    let far = far.replace("[2, 1, 1]", "[1, 1, 1]");
    assert!(read(&far).is_ok(), "far");
    let farther = far.replace("3e38, 0, 0]", "3.4e38, 0, 0], \"scale\": [1e37, 1, 1]");
    let error = read(&farther).expect_err("its far side is nowhere");
    let expected = "a.gltf: nodes[3]: expected a transform that keeps vertices finite";
    assert_eq!(error, expected, "nowhere");
}

#[test]
fn an_extension_places_a_mesh_many_times() {
    // The vertices of the square, as places; its texture coordinates are no places.
    let json = r#""extensionsRequired": ["EXT_mesh_gpu_instancing"], "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "scale": [2, 2, 2], "extensions": {"EXT_mesh_gpu_instancing":
            {"attributes": {"TRANSLATION": 0, "_ID": 1}}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 2}]}]"#;
    let scene = read(json).expect("a scene");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let twice = Affine3A::from_scale(Vec3::splat(2.0));
    let expected = corners.map(|[x, y]| twice * Affine3A::from_translation(Vec3::new(x, y, 0.0)));
    let transforms: Vec<_> = scene.instances.iter().map(|i| i.transform).collect();
    assert_eq!(transforms, expected, "in the node's space");
    assert_eq!(scene.triangle_count(), 8, "four squares");

    let scales = json.replace("\"TRANSLATION\"", "\"SCALE\"");
    let scene = read(&scales).expect("a scene");
    // In z all are flat.
    assert_eq!(scene.triangle_count(), 0, "none is left");
    let start = "a.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing.attributes: ";
    for (from, to, expected) in [
        (
            "\"TRANSLATION\": 0, ",
            "",
            "expected a member `TRANSLATION`, `ROTATION` or `SCALE`",
        ),
        (
            "\"_ID\": 1",
            "\"SCALE\": 3",
            "expected attributes of as many elements each",
        ),
        (
            "\"TRANSLATION\": 0",
            "\"ROTATION\": 4",
            "element 0 of `ROTATION`: expected a length of 1",
        ),
        (
            "\"TRANSLATION\": 0, \"_ID\": 1",
            "\"TRANSLATION\": 5",
            "expected at most 1048576 instances in all",
        ),
    ] {
        // Accessors without a view are of zeros.
        let broken = format!("{{{} {}}}", head(), json.replace(from, to)).replace(
            "\"count\": 6, \"type\": \"SCALAR\"}",
            "\"count\": 6, \"type\": \"SCALAR\"}, \
             {\"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\"}, \
             {\"componentType\": 5126, \"count\": 1, \"type\": \"VEC4\"}, \
             {\"componentType\": 5126, \"count\": 1048577, \"type\": \"VEC3\"}",
        );
        let scene = parse_gltf(Path::new("a.gltf"), broken.as_bytes(), Files::NONE);
        let error = scene.expect_err("not read").to_string();
        assert_eq!(error, format!("{start}{expected}"), "{to}");
    }
}

#[test]
fn binary_files_carry_their_buffer() {
    let json = format!("{{{} {LAMP}}}", SQUARE.replace("$URI", ""));
    let file = glb(&json, &square());
    let binary = parse_gltf(Path::new("a.glb"), &file, Files::NONE).expect("a scene");
    let text = read(LAMP).expect("a scene");
    assert_eq!(binary.meshes, text.meshes, "the same triangles");
    assert_eq!(binary.materials, text.materials, "the same materials");
}

#[test]
fn sparse_accessors_replace_elements() {
    let mut bytes = square();
    bytes.extend([3u8, 0, 0, 0]);
    bytes.extend([5.0f32, 6.0, 7.0].map(f32::to_le_bytes).concat());
    let uri = format!(r#", "uri": "{}""#, data_uri(&bytes));
    let sparse = r#""max": [1, 1, 0], "sparse": {"count": 1,
        "indices": {"bufferView": 3, "componentType": 5121}, "values": {"bufferView": 4}}"#;
    let json = SQUARE
        .replace(
            "\"byteLength\": 92 $URI",
            &format!("\"byteLength\": 108 {uri}"),
        )
        .replace(
            "\"byteLength\": 12}]",
            "\"byteLength\": 12}, {\"buffer\": 0, \
            \"byteOffset\": 92, \"byteLength\": 1}, \
            {\"buffer\": 0, \"byteOffset\": 96, \"byteLength\": 12}]",
        )
        .replace(r#""max": [1, 1, 0]"#, sparse);
    let json = format!(
        r#"{{{json} "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 2}}]}}]}}"#
    );
    let scene = parse_gltf(Path::new("a.gltf"), json.as_bytes(), Files::NONE).expect("a scene");
    let expected = [
        Vec3::ZERO,
        Vec3::X,
        Vec3::new(1.0, 1.0, 0.0),
        Vec3::new(5.0, 6.0, 7.0),
    ];
    assert_eq!(
        scene.meshes[0].positions, expected,
        "the last one is replaced"
    );
}
