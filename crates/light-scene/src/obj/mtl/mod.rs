//! Material libraries: the meaning of MTL parameters in this crate.

mod description;
mod texture;

use alloc::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::text::{Line, logical_lines, shown};
use crate::{Diagnostic, Files, MaterialId, Scene};

use description::Description;
use texture::{Content, Textures};

/// Adds the materials of a library to the scene; returns their names and ids.
pub(super) fn parse_mtl(
    path: &Path,
    text: &str,
    files: Files<'_>,
    scene: &mut Scene,
) -> Result<Vec<(String, MaterialId)>, Diagnostic> {
    let mut library = Library {
        scene,
        textures: Textures::new(files),
        described: Vec::new(),
        warned: BTreeSet::new(),
    };
    for (number, text) in logical_lines(text) {
        library.line(Line::new(path, number, &text))?;
    }
    library.finish(path)
}

struct Library<'a> {
    scene: &'a mut Scene,
    textures: Textures<'a>,
    /// The materials so far, each with where it starts.
    described: Vec<(Description, Diagnostic)>,
    /// The warnings so far.
    warned: BTreeSet<(PathBuf, String)>,
}

impl Library<'_> {
    fn line(&mut self, mut line: Line<'_>) -> Result<(), Diagnostic> {
        let Some(keyword) = line.word() else {
            return Ok(());
        };
        if keyword == "newmtl" {
            let material = Description::new(line.rest("a material's name")?);
            self.described.push((material, line.diagnostic("")));
            return Ok(());
        }
        let Some((material, _)) = self.described.last_mut() else {
            let message = format!("expected `newmtl NAME` before `{}`", shown(keyword));
            return Err(line.diagnostic(message));
        };
        let (map, content) = match keyword {
            "map_Kd" => (&mut material.diffuse_map, Content::Color),
            "map_Ke" => (&mut material.emitted_map, Content::Color),
            "map_d" => (&mut material.dissolve_map, Content::Opacity),
            _ => {
                if !material.parameter(keyword, &mut line)? {
                    let message = format!("`{}` is not understood and was ignored", shown(keyword));
                    self.warn(line.diagnostic(message));
                }
                return Ok(());
            }
        };
        let texture = self.textures.load(content, &mut line, self.scene)?;
        *map = texture.image;
        texture.warnings.into_iter().for_each(|w| self.warn(w));
        Ok(())
    }

    fn finish(mut self, path: &Path) -> Result<Vec<(String, MaterialId)>, Diagnostic> {
        if self.described.is_empty() {
            let message = "expected at least one material (`newmtl NAME`)";
            return Err(Diagnostic::file(path, message));
        }
        let mut added = Vec::with_capacity(self.described.len());
        for (material, start) in core::mem::take(&mut self.described) {
            for message in material.simplifications() {
                let message = message.to_owned();
                self.warn(Diagnostic {
                    message,
                    ..start.clone()
                });
            }
            let name = material.name.clone();
            let finished = material.into_material(self.scene);
            added.push((name, self.scene.add_material(finished)));
        }
        Ok(added)
    }

    /// Says something once for the library.
    fn warn(&mut self, warning: Diagnostic) {
        let said = (warning.path.clone(), warning.message.clone());
        if self.warned.insert(said) {
            self.scene.warnings.push(warning);
        }
    }
}

#[cfg(test)]
mod tests;
