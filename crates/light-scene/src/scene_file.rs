use std::path::Path;

use crate::gltf::parse_gltf;
use crate::gunzip::gunzipped;
use crate::obj::parse_obj;
use crate::pbrt::parse_pbrt;
use crate::text::{read_bytes, text_of};
use crate::{Diagnostic, Files, Scene};

/// Reads a scene by the ending of its name: `.obj`, `.pbrt`, `.gltf` or `.glb`, in capitals too.
///
/// # Errors
/// As the reader of the format; and when the ending is another.
pub fn read_scene(path: &Path) -> Result<Scene, Diagnostic> {
    if !is_scene_name(path) {
        return Err(Diagnostic::file(path, EXPECTED));
    }
    parse_scene(path, &read_bytes(path)?, Files::DISK)
}

/// As [`read_scene`], from the bytes of the file; `path` says by its ending which format they have,
/// names them in messages and is where the names of other files start from.
///
/// # Errors
/// As [`read_scene`].
pub fn parse_scene(path: &Path, bytes: &[u8], files: Files<'static>) -> Result<Scene, Diagnostic> {
    match ending(path).as_deref() {
        Some("obj") => parse_obj(path, &text_of(bytes), files),
        Some("pbrt") => parse_pbrt(path, &text_of(&gunzipped(path, bytes)?), files),
        Some("gltf" | "glb") => parse_gltf(path, bytes, files),
        _ => Err(Diagnostic::file(path, EXPECTED)),
    }
}

const EXPECTED: &str = "expected a scene file: .obj, .pbrt, .gltf or .glb";

/// Whether a file of this name is a scene by its ending.
#[must_use]
pub fn is_scene_name(path: &Path) -> bool {
    let ending = ending(path);
    matches!(ending.as_deref(), Some("obj" | "pbrt" | "gltf" | "glb"))
}

/// The ending of a name in lower case.
fn ending(path: &Path) -> Option<String> {
    Some(path.extension()?.to_str()?.to_ascii_lowercase())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// The bytes of a file of `testdata/three_formats`, behind a byte order mark if it is a text.
    fn read_marked(path: &Path) -> Result<Vec<u8>, Diagnostic> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("testdata/three_formats");
        let mut bytes = fs::read(folder.join(path)).expect("a file");
        let ending = ending(path);
        if matches!(
            ending.as_deref(),
            Some("obj" | "mtl" | "pbrt" | "gltf" | "ply")
        ) {
            bytes.splice(..0, *b"\xef\xbb\xbf");
        }
        Ok(bytes)
    }

    #[test]
    fn endings_are_matched_without_case() {
        for name in ["room.obj", "room.pbrt", "room.gltf"] {
            let bytes = read_marked(Path::new(name)).expect("bytes");
            let upper = name.to_ascii_uppercase();
            assert!(is_scene_name(Path::new(&upper)), "{upper}");
            let scene = parse_scene(Path::new(&upper), &bytes, Files::new(&read_marked));
            assert!(scene.is_ok(), "{upper}: {:?}", scene.err());
        }
        assert!(!is_scene_name(Path::new("room.objx")), "another");
    }

    #[test]
    fn texts_may_begin_with_a_byte_order_mark() {
        for name in ["room.obj", "room.pbrt", "room.gltf"] {
            let path = Path::new(name);
            let marked = read_marked(path).expect("bytes");
            let scene = parse_scene(path, &marked, Files::new(&read_marked));
            let scene = scene.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(scene.warnings, [], "{name}");
            assert!(scene.emissive_triangle_count() > 0, "{name}: its materials");
        }
        let ply = "\u{feff}ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n\
                   property float y\nproperty float z\nelement face 1\n\
                   property list uchar int vertex_indices\nend_header\n\
                   0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
        let mesh = crate::parse_ply(Path::new("a.ply"), ply.as_bytes());
        assert_eq!(mesh.map(|mesh| mesh.indices.len()), Ok(1));
    }
}
