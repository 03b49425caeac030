use std::path::Path;

use crate::gltf::parse_gltf;
use crate::gunzip::gunzipped;
use crate::obj::parse_obj;
use crate::pbrt::parse_pbrt;
use crate::text::{read_bytes, text_of};
use crate::{Diagnostic, Files, Scene};

/// Reads a scene by the ending of its name: `.obj`, `.pbrt`, `.gltf` or `.glb`.
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
    match ending(path) {
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
    matches!(ending(path), Some("obj" | "pbrt" | "gltf" | "glb"))
}

fn ending(path: &Path) -> Option<&str> {
    path.extension()?.to_str()
}
