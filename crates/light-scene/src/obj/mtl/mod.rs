//! Material libraries: the meaning of MTL parameters in this crate.

mod description;
mod parameter;
mod texture;

use alloc::borrow::Cow;
use alloc::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::cleaned::{Cleaned, Cleaner, Handed};
use crate::text::{Line, shown};
use crate::{Diagnostic, Files, MaterialId, Scene};

use description::Description;
use texture::{Content, Textures};

/// The parameters that name an image, and what it gives.
const MAPS: [(&str, Content); 3] = [
    ("map_Kd", Content::Color),
    ("map_Ke", Content::Color),
    ("map_d", Content::Opacity),
];

/// Adds the materials of a library to the scene; returns their names and ids.
pub(super) fn parse_mtl(
    path: &Path,
    text: &str,
    files: Files<'_>,
    scene: &mut Scene,
) -> Result<Vec<(String, MaterialId)>, Diagnostic> {
    let mut lines = Cleaned::new(path, text, Library::default());
    let (materials, _) = match tobj::load_mtl_buf(&mut lines) {
        Ok(loaded) => loaded,
        Err(error) => {
            let fault = lines.fault();
            return Err(fault.unwrap_or_else(|| lines.at_last_line(error)));
        }
    };
    if materials.is_empty() {
        let message = "expected at least one material (`newmtl NAME`)";
        return Err(Diagnostic::file(path, message));
    }
    let Library {
        places,
        mut warnings,
        ..
    } = lines.cleaner;
    let mut textures = Textures::new(files);
    let mut described = Vec::with_capacity(materials.len());
    for (material, place) in materials.iter().zip(&places) {
        let mut description = Description::of(material);
        for (number, (keyword, content)) in place.maps_by_line() {
            let Some(name) = map_of(material, keyword) else {
                continue;
            };
            let mut line = Line::new(path, number, name);
            let texture = textures.load(content, &mut line, scene)?;
            let said = texture.warnings.into_iter();
            said.for_each(|warning| warnings.add(number, warning));
            description.set_map(keyword, texture.image);
        }
        described.push(description);
    }
    let mut added = Vec::with_capacity(described.len());
    for (description, place) in described.into_iter().zip(&places) {
        let start = Line::new(path, place.start, "");
        for message in description.simplifications() {
            warnings.add(place.start, start.diagnostic(message));
        }
        let name = description.name.clone();
        let finished = description.into_material(scene);
        added.push((name, scene.add_material(finished)));
    }
    scene.warnings.extend(warnings.by_line());
    Ok(added)
}

/// What a material says of an image: options and a name.
fn map_of<'a>(material: &'a tobj::Material, keyword: &str) -> Option<&'a str> {
    match keyword {
        "map_Kd" => material.diffuse_texture.as_deref(),
        "map_d" => material.dissolve_texture.as_deref(),
        other => material.unknown_param.get(other).map(String::as_str),
    }
}

/// Looks at the lines of a library before `tobj` reads them.
#[derive(Debug, Default)]
struct Library {
    /// Where each material is described.
    places: Vec<Place>,
    names: BTreeSet<String>,
    warnings: Warnings,
}

/// The lines of a material.
#[derive(Debug)]
struct Place {
    start: usize,
    /// Those of its images, by keyword.
    maps: BTreeMap<&'static str, usize>,
}

impl Place {
    /// The lines that name images, from the first on.
    fn maps_by_line(&self) -> Vec<(usize, (&'static str, Content))> {
        let named = MAPS.into_iter().filter_map(|map| {
            let &number = self.maps.get(map.0)?;
            Some((number, map))
        });
        let mut named: Vec<_> = named.collect();
        named.sort_unstable_by_key(|(number, _)| *number);
        named
    }
}

/// What is said once for the library.
#[derive(Debug, Default)]
struct Warnings {
    /// Each with the line of the library that it comes from.
    list: Vec<(usize, Diagnostic)>,
    said: BTreeSet<(PathBuf, String)>,
}

impl Warnings {
    fn add(&mut self, line: usize, warning: Diagnostic) {
        let said = (warning.path.clone(), warning.message.clone());
        if self.said.insert(said) {
            self.list.push((line, warning));
        }
    }

    /// All of them, those of the first line first.
    fn by_line(mut self) -> impl Iterator<Item = Diagnostic> {
        self.list.sort_by_key(|(line, _)| *line);
        self.list.into_iter().map(|(_, warning)| warning)
    }
}

impl Cleaner for Library {
    fn clean<'a>(
        &mut self,
        mut line: Line<'_>,
        text: Cow<'a, str>,
        handed: &mut Handed<'a>,
    ) -> Result<(), Diagnostic> {
        let Some(keyword) = line.word() else {
            return Ok(());
        };
        if keyword == "newmtl" {
            let name = line.rest("a material's name")?;
            handed.line(format!("newmtl {name}"));
            if !self.names.insert(name.clone()) {
                let name = shown(&name);
                let message = format!("material `{name}` is described again: the last one counts");
                self.warnings
                    .add(line.number_in_file(), line.diagnostic(message));
            }
            self.places.push(Place {
                start: line.number_in_file(),
                maps: BTreeMap::new(),
            });
            return Ok(());
        }
        let Some(place) = self.places.last_mut() else {
            let message = format!("expected `newmtl NAME` before `{}`", shown(keyword));
            return Err(line.diagnostic(message));
        };
        if parameter::is_cut(keyword, &line) {
            let message = format!("`{keyword}` above 1 was taken as 1");
            self.warnings
                .add(line.number_in_file(), line.diagnostic(message));
        }
        if let Some((map, _)) = MAPS.into_iter().find(|(map, _)| *map == keyword) {
            place.maps.insert(map, line.number_in_file());
            line.rest("a file name")?;
            handed.line(text);
        } else if let Some(written) = parameter::written(keyword, &mut line)? {
            if !written.is_empty() {
                handed.line(format!("{keyword} {written}"));
            }
        } else {
            let message = format!("`{keyword}` is not understood and was ignored");
            self.warnings
                .add(line.number_in_file(), line.diagnostic(message));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
