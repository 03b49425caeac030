use std::path::Path;

use light_scene::{
    Color, Diagnostic, Files, Mesh, Scene, parse_image, parse_luminaire, parse_obj, parse_ply,
    parse_scene,
};

/// A file of any format, which the first byte chooses, is read or refused with a one-line error.
///
/// # Panics
/// If a guarantee is violated.
pub fn readers(data: &[u8]) {
    let Some((format, data)) = data.split_first() else {
        return;
    };
    match format % 7 {
        0 => read_gltf(data),
        1 => read_image(data),
        2 => read_luminaire(data),
        3 => read_mtl(data),
        4 => read_obj(data),
        5 => read_pbrt(data),
        _ => read_ply(data),
    }
}

/// An OBJ file gives a valid scene or a one-line error.
fn read_obj(data: &[u8]) {
    scene(parse_scene(Path::new("a.obj"), data, Files::NONE));
}

/// A material library gives a valid scene or a one-line error.
fn read_mtl(data: &[u8]) {
    let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    let library = |path: &Path| match path.to_str() {
        Some("a.mtl") => Ok(data.to_vec()),
        _ => Err(Diagnostic::file(path, "cannot be read")),
    };
    scene(parse_obj(Path::new("a.obj"), obj, Files::new(&library)));
}

/// A pbrt file gives a valid scene or a one-line error.
fn read_pbrt(data: &[u8]) {
    scene(parse_scene(Path::new("a.pbrt"), data, Files::NONE));
}

/// A PLY file gives a valid mesh or a one-line error.
fn read_ply(data: &[u8]) {
    if let Some(ply) = answer(parse_ply(Path::new("a.ply"), data)) {
        indices(&ply);
        let finite = ply.positions.iter().all(|position| position.is_finite());
        assert!(finite, "a vertex that is nowhere");
    }
}

/// A glTF file, text or binary, gives a valid scene or a one-line error.
fn read_gltf(data: &[u8]) {
    scene(parse_scene(Path::new("a.gltf"), data, Files::NONE));
}

/// An image file of any format gives finite texels of at least 0 or a one-line error.
fn read_image(data: &[u8]) {
    for name in ["a.exr", "a.hdr", "a.png"] {
        if let Some(file) = answer(parse_image(Path::new(name), data)) {
            let is_light =
                |texel: &light_scene::glam::Vec3| texel.is_finite() && texel.min_element() >= 0.0;
            assert!(
                file.image.texels().iter().all(is_light),
                "a texel that is no light"
            );
        }
    }
}

/// A photometric file of either format gives a web of finite power or a one-line error.
fn read_luminaire(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    for name in ["a.ies", "a.ldt"] {
        if let Some(luminaire) = answer(parse_luminaire(Path::new(name), &text, Files::NONE)) {
            let lumens = luminaire.web.total_lumens();
            assert!(lumens >= 0.0, "{lumens} lm");
        }
    }
}

fn scene(answered: Result<Scene, Diagnostic>) {
    let Some(scene) = answer(answered) else {
        return;
    };
    for warning in &scene.warnings {
        one_line(warning);
    }
    let image = |color: &Color| {
        if let Color::Image(texture) = color {
            assert!((texture.image.0 as usize) < scene.images.len(), "an image");
        }
    };
    for material in &scene.materials {
        material
            .emission
            .iter()
            .for_each(|emission| image(&emission.radiance));
        material
            .alpha
            .iter()
            .for_each(|alpha| image(&alpha.opacity));
    }
    for instance in &scene.instances {
        assert!(
            (instance.prototype.0 as usize) < scene.prototypes.len(),
            "a prototype"
        );
        assert!(instance.transform.is_finite(), "a transform");
    }
    let prototypes = scene.prototypes.iter();
    let placed = prototypes.flat_map(|prototype| &prototype.meshes);
    for mesh in scene.meshes.iter().chain(placed) {
        assert!(
            (mesh.material.0 as usize) < scene.materials.len(),
            "a material"
        );
        indices(mesh);
    }
}

/// Every corner of a triangle is there, with its normal and its texture coordinates.
fn indices(mesh: &Mesh) {
    let count = mesh.positions.len();
    let mut corners = mesh.indices.as_flattened().iter();
    assert!(corners.all(|&i| (i as usize) < count), "a vertex");
    if let Some(normals) = &mesh.normals {
        assert_eq!(normals.len(), count, "normals");
    }
    if let Some(uvs) = &mesh.uvs {
        assert_eq!(uvs.len(), count, "texture coordinates");
    }
    if let Some(uvs) = &mesh.second_uvs {
        assert_eq!(uvs.len(), count, "second texture coordinates");
    }
    if let Some(tangents) = &mesh.tangents {
        assert_eq!(tangents.len(), count, "tangents");
    }
    if let Some(colors) = &mesh.colors {
        assert_eq!(colors.len(), count, "colours");
    }
}

fn answer<T>(answered: Result<T, Diagnostic>) -> Option<T> {
    answered.map_err(|error| one_line(&error)).ok()
}

fn one_line(diagnostic: &Diagnostic) {
    let shown = diagnostic.to_string();
    assert_eq!(shown.lines().count(), 1, "one line: {shown:?}");
}
