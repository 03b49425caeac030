//! Lamps with an alpha mask are as bright as their opaque share, from every file format and by
//! every estimator.

use std::fs;

use light_render::integrator::Estimator;
use light_scene::{Scene, read_gltf, read_obj, read_pbrt};

use crate::support::{Shot, plane};

/// The mean over the file's scene, from the camera over a plane.
fn mean(scene: &Scene, estimator: Estimator) -> (f64, f64) {
    let mut scene = scene.clone();
    scene.camera = plane(0.5, 1.0).camera;
    let shot = Shot {
        estimator,
        spp: if estimator == Estimator::Bsdf {
            256
        } else {
            16
        },
        max_depth: 2,
        ..Shot::default()
    };
    let (mean, error) = shot.mean(&scene);
    (mean.x, error.x)
}

const ESTIMATORS: [Estimator; 3] = [Estimator::Mis, Estimator::Light, Estimator::Bsdf];

/// `part` is as bright as a share of `whole`, which may differ by estimator.
fn check(name: &str, whole: &Scene, part: &Scene, share: impl Fn(Estimator) -> f64) {
    let (full, full_error) = mean(whole, Estimator::Light);
    assert!(full > 0.01, "{name}: the lamp emits light: {full}");
    for estimator in ESTIMATORS {
        let ((part, error), share) = (mean(part, estimator), share(estimator));
        let margin = 3.0 * (error + share * full_error) + 1e-4 * full;
        assert!(
            (part - share * full).abs() <= margin,
            "{name}, {estimator:?}: {part} of {full}"
        );
    }
}

#[test]
fn lamps_of_pbrt_files() {
    let folder = std::env::temp_dir().join(format!("alpha_files_pbrt_{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let read = |name: &str, shape: &str| {
        let text = format!(
            "WorldBegin\nMaterial \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n\
             Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n\
             \"point3 P\" [-1 0 -1  -1 0 1  1 0 1  1 0 -1]\n\
             AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [3 3 3]\n{shape}\nAttributeEnd\n"
        );
        let path = folder.join(name);
        fs::write(&path, text).expect("a file");
        read_pbrt(&path).expect("a scene")
    };
    let square = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \
                  \"point3 P\" [-2 3 -2  2 3 -2  2 3 2  -2 3 2]";
    let sphere = "Translate 0 3 0\nShape \"sphere\" \"float radius\" 0.5";
    for (name, shape) in [("square", square), ("sphere", sphere)] {
        let whole = read(&format!("{name}.pbrt"), shape);
        let half = read(
            &format!("{name}_half.pbrt"),
            &format!("{shape} \"float alpha\" 0.5"),
        );
        check(name, &whole, &half, |_| 0.5);
        // An invisible light, which no ray finds.
        let invisible = read(
            &format!("{name}_invisible.pbrt"),
            &format!("{shape} \"float alpha\" 0"),
        );
        check(name, &whole, &invisible, |estimator| match estimator {
            Estimator::Bsdf => 0.0,
            _ => 1.0,
        });
    }
    fs::remove_dir_all(&folder).expect("removed");
}

#[test]
fn lamps_of_obj_files() {
    let folder = std::env::temp_dir().join(format!("alpha_files_obj_{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let read = |name: &str, alpha: &str| {
        let materials =
            format!("newmtl matt\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 3 3 3\n{alpha}\n");
        fs::write(folder.join(format!("{name}.mtl")), materials).expect("a file");
        let text = format!(
            "mtllib {name}.mtl\nv -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nv -2 3 -2\nv 2 3 -2\n\
             v 2 3 2\n\
             v -2 3 2\nusemtl matt\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n"
        );
        let path = folder.join(format!("{name}.obj"));
        fs::write(&path, text).expect("a file");
        read_obj(&path).expect("a scene")
    };
    let whole = read("whole", "");
    for (share, d) in [
        (0.5, "d 0.5"),
        (0.0, "d 0"),
        (0.25, "Tr 0.75"),
        (0.0, "Tr 1"),
    ] {
        check(d, &whole, &read(&d.replace(' ', "_"), d), |_| share);
    }
    fs::remove_dir_all(&folder).expect("removed");
}

#[test]
fn lamps_of_gltf_files() {
    let folder = std::env::temp_dir().join(format!("alpha_files_gltf_{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let floor = [-1.0f32, 0., -1., -1., 0., 1., 1., 0., 1., 1., 0., -1.];
    let lamp = [-2.0f32, 3., -2., 2., 3., -2., 2., 3., 2., -2., 3., 2.];
    let mut bytes = [floor, lamp]
        .concat()
        .into_iter()
        .flat_map(f32::to_le_bytes)
        .collect::<Vec<_>>();
    bytes.extend([0u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes));
    fs::write(folder.join("a.bin"), bytes).expect("a file");
    let read = |name: &str, alpha: &str, opacity: f32| {
        let text = format!(
            r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}],
            "nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [
                {{"attributes": {{"POSITION": 0}}, "indices": 2, "material": 0}},
                {{"attributes": {{"POSITION": 1}}, "indices": 2, "material": 1}}]}}],
            "bufferViews": [{{"buffer": 0, "byteLength": 96}},
                {{"buffer": 0, "byteOffset": 96, "byteLength": 12}}],
            "accessors": [
                {{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                    "min": [-1, 0, -1], "max": [1, 0, 1]}},
                {{"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4,
                    "type": "VEC3", "min": [-2, 3, -2], "max": [2, 3, 2]}},
                {{"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}}],
            "buffers": [{{"byteLength": 108, "uri": "a.bin"}}],
            "materials": [
                {{"pbrMetallicRoughness": {{"baseColorFactor": [0.5, 0.5, 0.5, 1],
                    "metallicFactor": 0}}}},
                {{"emissiveFactor": [1, 1, 1], {alpha},
                    "extensions": {{"KHR_materials_emissive_strength":
                    {{"emissiveStrength": 2000}}}},
                    "pbrMetallicRoughness": {{"baseColorFactor": [0, 0, 0, {opacity}],
                        "metallicFactor": 0}}}}]}}"#
        );
        let path = folder.join(format!("{name}.gltf"));
        fs::write(&path, text).expect("a file");
        read_gltf(&path).expect("a scene")
    };
    let whole = read("whole", r#""alphaMode": "OPAQUE""#, 0.5);
    for share in [0.5, 0.0] {
        let part = read("part", r#""alphaMode": "BLEND""#, share);
        check("gltf", &whole, &part, |_| f64::from(share));
    }
    fs::remove_dir_all(&folder).expect("removed");
}
