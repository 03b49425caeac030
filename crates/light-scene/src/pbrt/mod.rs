//! pbrt-v4 scene files.

mod area_lights;
mod attribute_target;
mod attributes;
#[cfg(test)]
mod cameras_tests;
mod checkerboard;
mod cloud;
mod colors;
mod curves;
mod directives;
mod file_loc;
#[cfg(test)]
mod files_tests;
#[cfg(test)]
mod frames_tests;
mod goniometric;
mod image_key;
mod image_map;
mod included;
mod includes;
#[cfg(test)]
mod leniency_tests;
#[cfg(test)]
mod lenient_files_tests;
mod light_check;
mod lights;
#[cfg(test)]
mod lights_tests;
mod loop_subdivision;
mod material_names;
mod materials;
#[cfg(test)]
mod materials_tests;
mod media;
mod medium_grid;
mod medium_slot;
mod meshes;
mod named_materials;
mod object_slots;
mod objects;
#[cfg(test)]
mod objects_tests;
mod parameter;
mod parameters;
#[cfg(test)]
mod parameters_tests;
mod ply;
mod quadrics;
#[cfg(test)]
mod quadrics_tests;
#[cfg(test)]
mod refusals_tests;
mod shapes;
mod spectrum;
mod state;
mod texture_kind;
mod textures;
#[cfg(test)]
mod textures_tests;
mod tokens;
mod upgrade;
mod version3;
mod view;

use std::path::Path;

use crate::gunzip::gunzipped;
use crate::text::{read_bytes, text_of};
use crate::{Diagnostic, Files, Scene};

pub use ply::parse_ply;
use state::Reader;

/// Reads a pbrt-v4 file and what it includes.
///
/// The supported features are listed in the crate's documentation; everything else is named once in
/// a warning. Coordinates stay as written; the camera keeps pbrt's left-handed view.
///
/// # Errors
/// When a file cannot be read, is no pbrt file, or a directive lacks what it needs: with file, line
/// and what was expected.
pub fn read_pbrt(path: &Path) -> Result<Scene, Diagnostic> {
    let bytes = read_bytes(path)?;
    parse_pbrt(path, &text_of(&gunzipped(path, &bytes)?), Files::DISK)
}

/// As [`read_pbrt`], from the text of the file; `path` names it in messages and is where other
/// files' names start from.
pub(crate) fn parse_pbrt(
    path: &Path,
    text: &str,
    files: Files<'static>,
) -> Result<Scene, Diagnostic> {
    let mut reader = Reader::default();
    reader.files = files;
    path.clone_into(&mut reader.root);
    match reader.file(path, text, 0) {
        Ok(()) => {
            let mut scene = reader.finish(path)?;
            scene.drop_coincident_emitters(path);
            Ok(scene)
        }
        Err(error) => Err(reader.explained(error)),
    }
}

#[cfg(test)]
mod media_tests;
#[cfg(test)]
mod tests;
