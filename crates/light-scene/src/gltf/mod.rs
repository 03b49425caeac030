//! glTF 2.0 files, as text (`.gltf`) and as one binary file (`.glb`).

mod accessor;
mod buffers;
mod data_uri;
mod document;
mod glb;
mod gpu_instancing;
mod instances;
mod item;
mod known_materials;
mod lights;
#[cfg(test)]
mod lights_tests;
mod materials;
mod mesh_uses;
mod nodes;
mod passed_over;
mod primitives;
mod reader;
#[cfg(test)]
mod refusals_tests;
mod required_extensions;
mod surfaces;
#[cfg(test)]
mod surfaces_tests;
#[cfg(test)]
mod tests;
mod texture_images;
mod textures;
#[cfg(test)]
mod textures_tests;
mod unread_members;
mod uv_sets;
mod warnings;

use std::path::Path;

use crate::text::read_bytes;
use crate::{Diagnostic, Files, Scene};

/// Reads a glTF file, as text or binary, and what it names.
///
/// The supported features are listed in the crate's documentation; everything else is named once in
/// a warning, by its path in the document. Lengths are metres; the camera looks along -z with y up.
///
/// # Errors
/// When a file cannot be read, is no glTF file, or a part of it is invalid: with file, path in
/// the document or byte, and what was expected.
///
/// # Source
/// `[GLTF]`.
pub fn read_gltf(path: &Path) -> Result<Scene, Diagnostic> {
    parse_gltf(path, &read_bytes(path)?, Files::DISK)
}

/// As [`read_gltf`], from the bytes of the file; `path` names it in messages and is where other
/// files' names start from.
pub(crate) fn parse_gltf(path: &Path, bytes: &[u8], files: Files<'_>) -> Result<Scene, Diagnostic> {
    let glb::Chunks { json, binary } = glb::chunks(path, bytes)?;
    let document = document::Document::parse(path, json)?;
    let mut scene = reader::Reader::new(&document, binary, files)?.read()?;
    scene.drop_coincident_emitters(path);
    Ok(scene)
}
