//! Wavefront OBJ with its material library (MTL).

mod faces;
mod mtl;

use alloc::collections::BTreeSet;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

use crate::glam::Vec3;
use crate::text::{Line, logical_lines, read_text, shown, text_of};
use crate::{Diagnostic, Files, Material, MaterialId, Scene};

use faces::Faces;

/// Reads an OBJ file and the material libraries it names.
///
/// Understood: `v`, `vt`, `vn`, `f` (any polygon, negative indices), `o`, `g`, `usemtl`, `mtllib`,
/// `#` and lines continued with a backslash; MTL as the crate's documentation says. Everything else
/// is named once in a warning.
///
/// # Errors
/// When a file cannot be read, a line is broken, an index points nowhere, a material is not
/// defined, or there is no face: with file, line and what was expected.
pub fn read_obj(path: &Path) -> Result<Scene, Diagnostic> {
    parse_obj(path, &read_text(path)?, Files::DISK)
}

/// As [`read_obj`], from the text of the file; `path` names it in messages and is where the names
/// of libraries start from.
///
/// # Errors
/// As [`read_obj`].
pub fn parse_obj(path: &Path, text: &str, files: Files<'_>) -> Result<Scene, Diagnostic> {
    let mut reader = Reader {
        files,
        scene: Scene::default(),
        materials: HashMap::new(),
        libraries: BTreeSet::new(),
        ignored: BTreeSet::new(),
        faces: Faces::default(),
    };
    for (number, text) in logical_lines(text) {
        reader.line(Line::new(path, number, &text))?;
    }
    reader.scene.meshes = reader.faces.into_meshes();
    if reader.scene.meshes.is_empty() {
        return Err(Diagnostic::file(path, "expected at least one face (`f`)"));
    }
    Ok(reader.scene)
}

struct Reader<'a> {
    files: Files<'a>,
    scene: Scene,
    materials: HashMap<String, MaterialId>,
    libraries: BTreeSet<String>,
    /// Keywords that a warning has named already.
    ignored: BTreeSet<String>,
    faces: Faces,
}

impl Reader<'_> {
    fn line(&mut self, mut line: Line<'_>) -> Result<(), Diagnostic> {
        let Some(keyword) = line.word() else {
            return Ok(());
        };
        match keyword {
            "v" => self.vertex(&mut line)?,
            "vt" => self.faces.uvs.push(line.vec2("a texture coordinate")?),
            "vn" => self.faces.normals.push(line.vec3("a normal's coordinate")?),
            "f" => {
                let material = self.current_material();
                self.faces.push_polygon(material, &mut line)?;
            }
            "o" | "g" => self
                .faces
                .begin_group(line.rest("a name").unwrap_or_default()),
            "usemtl" => {
                let name = line.rest("a material's name")?;
                self.faces.material = Some(self.material(name, &line)?);
            }
            "mtllib" => self.load_libraries(&mut line)?,
            // Smoothing groups: files that want smooth shading give normals.
            "s" => {}
            other => self.ignore(other, &line, "is not understood and was ignored"),
        }
        Ok(())
    }

    fn vertex(&mut self, line: &mut Line<'_>) -> Result<(), Diagnostic> {
        let mut position = line.vec3("a vertex coordinate")?;
        if let Some(w) = line.optional_number("a weight")? {
            let has_color = line.optional_number("a colour")?.is_some();
            if has_color {
                self.ignore("v", line, "has vertex colours, which were ignored");
            } else {
                position /= w;
            }
            if !position.is_finite() {
                return Err(line.diagnostic("expected a weight other than 0"));
            }
        }
        self.faces.positions.push(position);
        Ok(())
    }

    /// The material in force, which is grey if the file named none.
    fn current_material(&mut self) -> MaterialId {
        let scene = &mut self.scene;
        let material = &mut self.faces.material;
        *material.get_or_insert_with(|| {
            scene.add_material(Material::diffuse("default", Vec3::splat(0.5)))
        })
    }

    /// The material of this name; grey, with a warning, if the file names no library at all.
    fn material(&mut self, name: String, line: &Line<'_>) -> Result<MaterialId, Diagnostic> {
        if let Some(&id) = self.materials.get(&name) {
            return Ok(id);
        }
        let name_shown = shown(&name);
        if !self.libraries.is_empty() {
            let libraries: Vec<&str> = self.libraries.iter().map(String::as_str).collect();
            let libraries = libraries.join(", ");
            let message = format!("expected a material of {libraries}, found `{name_shown}`");
            return Err(line.diagnostic(message));
        }
        let message = format!("material `{name_shown}` is grey: no `mtllib` line before");
        self.scene.warnings.push(line.diagnostic(message));
        let grey = Material::diffuse(name.clone(), Vec3::splat(0.5));
        let id = self.scene.add_material(grey);
        self.materials.insert(name, id);
        Ok(id)
    }

    /// One name that may hold blanks or, where no such file is, several names.
    fn load_libraries(&mut self, line: &mut Line<'_>) -> Result<(), Diagnostic> {
        let names = line.rest("a file name")?;
        let is_file = self.files.read(&library_path(&names, line)).is_ok();
        if is_file || !names.contains(' ') {
            return self.load_library(&names, line);
        }
        let mut each = names.split(' ');
        each.try_for_each(|name| self.load_library(name, line))
    }

    fn load_library(&mut self, name: &str, line: &Line<'_>) -> Result<(), Diagnostic> {
        if self.libraries.contains(name) {
            return Ok(());
        }
        let file = library_path(name, line);
        let bytes = self.files.read(&file).map_err(|error| {
            line.diagnostic(format!(
                "material library `{}`: {}",
                shown(name),
                error.message
            ))
        })?;
        let known = mtl::parse_mtl(&file, &text_of(&bytes), self.files, &mut self.scene)?;
        self.materials.extend(known);
        self.libraries.insert(name.to_owned());
        Ok(())
    }

    fn ignore(&mut self, keyword: &str, line: &Line<'_>, what: &str) {
        if self.ignored.insert(keyword.to_owned()) {
            let message = format!("`{}` {what}", shown(keyword));
            self.scene.warnings.push(line.diagnostic(message));
        }
    }
}

/// Where a library is, whose name starts from the folder of the OBJ file.
fn library_path(name: &str, line: &Line<'_>) -> PathBuf {
    // Files from other systems separate folders with backslashes.
    line.path().with_file_name(name.replace('\\', "/"))
}

#[cfg(test)]
mod tests;
