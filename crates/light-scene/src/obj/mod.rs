//! Wavefront OBJ with its material library (MTL), read by `tobj`.

mod cleaned;
mod corner;
mod mtl;
mod reader;
mod sections;

use std::path::Path;

use lights::math::Aabb;

use crate::extent_fault::extent_fault;
use crate::text::{Line, logical_lines, read_text};
use crate::{Diagnostic, Files, Location, Scene};

use cleaned::Cleaned;
use reader::Reader;
use sections::BadFace;

/// Reads an OBJ file and the material libraries it names.
///
/// Understood: `v`, `vt`, `vn`, `f` (any polygon, negative indices), `o`, `g`, `usemtl`, `mtllib`,
/// `#` and lines continued with a backslash; MTL as the crate's documentation says. Everything else
/// is named once in a warning. So are libraries and textures that are missing, materials that no
/// library has, and normals that are named where there is none: what they would colour is grey.
///
/// # Errors
/// When a file cannot be read, a line is broken, an index points nowhere, or there is no face: with
/// file, line and what was expected.
pub fn read_obj(path: &Path) -> Result<Scene, Diagnostic> {
    parse_obj(path, &read_text(path)?, Files::DISK)
}

/// As [`read_obj`], from the text of the file; `path` names it in messages and is where the names
/// of libraries start from.
///
/// # Errors
/// As [`read_obj`].
pub fn parse_obj(path: &Path, text: &str, files: Files<'_>) -> Result<Scene, Diagnostic> {
    let mut lines = Cleaned::new(path, text, Reader::new(files));
    let options = tobj::LoadOptions {
        single_index: true,
        ..tobj::LoadOptions::default()
    };
    // Libraries are read where they are named.
    let library = |_: &Path| Ok(Default::default());
    let (objects, _) = match tobj::load_obj_buf(&mut lines, &options, library) {
        Ok(loaded) => loaded,
        Err(error) => {
            let fault = lines.fault().or_else(|| broken_number(path, text));
            return Err(fault.unwrap_or_else(|| lines.at_last_line(error)));
        }
    };
    let is_finite = |numbers: &[f32]| numbers.iter().all(|number| number.is_finite());
    let all_finite = objects.iter().all(|object| {
        let tobj::Mesh {
            positions,
            texcoords,
            normals,
            ..
        } = &object.mesh;
        is_finite(positions) && is_finite(texcoords) && is_finite(normals)
    });
    if !all_finite {
        let unknown = || Diagnostic::file(path, "expected finite coordinates");
        return Err(broken_number(path, text).unwrap_or_else(unknown));
    }
    let Reader {
        mut scene,
        sections,
        ..
    } = lines.cleaner;
    let meshes = sections.meshes(&objects);
    scene.meshes = meshes.map_err(|face| of_face(path, text, &face))?;
    if scene.meshes.is_empty() {
        let has_faces = objects.iter().any(|object| !object.mesh.indices.is_empty());
        let with_area = if has_faces { " with an area" } else { "" };
        let message = format!("expected at least one face (`f`){with_area}");
        return Err(Diagnostic::file(path, message));
    }
    if let Some(message) = extent_fault(&scene.bounds()) {
        return Err(of_extent(path, text, &scene.bounds(), message));
    }
    scene.drop_coincident_emitters(path);
    Ok(scene)
}

/// The error of a scene that is too large: the first vertex that is farthest from the origin.
fn of_extent(path: &Path, text: &str, bounds: &Aabb, message: String) -> Diagnostic {
    let reach = bounds.min.abs().max(bounds.max.abs()).max_element();
    let farthest = logical_lines(text).find_map(|(number, text)| {
        let mut line = Line::new(path, number, &text);
        let is_vertex = line.word() == Some("v");
        let position = is_vertex.then(|| line.vec3("a vertex coordinate").ok())??;
        (position.abs().max_element() >= reach).then_some(number)
    });
    let location = farthest.map_or(Location::File, Location::Line);
    Diagnostic::at(path, location, message)
}

/// The first line whose numbers are not finite, or fewer than they should be.
fn broken_number(path: &Path, text: &str) -> Option<Diagnostic> {
    logical_lines(text).find_map(|(number, text)| {
        let mut line = Line::new(path, number, &text);
        match line.word()? {
            "v" => {
                let weighted = line.vec3("a vertex coordinate").and_then(|position| {
                    let weight = line.optional_number("a weight")?;
                    let has_color = line.word().is_some();
                    let weight = weight.filter(|_| !has_color).unwrap_or(1.0);
                    Ok((position / weight).is_finite())
                });
                match weighted {
                    Ok(true) => None,
                    Ok(false) => Some(line.diagnostic("expected a weight other than 0")),
                    Err(error) => Some(error),
                }
            }
            "vt" => line.number("a texture coordinate").err().or_else(|| {
                let second = line.optional_number("a texture coordinate");
                second.err()
            }),
            "vn" => line.vec3("a normal's coordinate").err(),
            _ => None,
        }
    })
}

/// The error of a face: the first one with as many corners.
fn of_face(path: &Path, text: &str, face: &BadFace) -> Diagnostic {
    let mut lines = logical_lines(text);
    let found = lines.find(|(_, text)| {
        let mut words = text.split_whitespace();
        words.next() == Some("f") && words.count() == face.corners
    });
    match found {
        Some((number, _)) => Line::new(path, number, "").diagnostic(face.message.clone()),
        None => Diagnostic::file(path, face.message.clone()),
    }
}

#[cfg(test)]
mod refusals_tests;
#[cfg(test)]
mod tests;
