use alloc::borrow::Cow;
use alloc::collections::BTreeSet;
use std::collections::HashMap;
use std::path::PathBuf;

use super::cleaned::{Cleaner, Handed};
use super::corner::{Corner, Counts};
use super::mtl;
use super::sections::Sections;
use crate::glam::Vec3;
use crate::text::{Line, text_of};
use crate::{Diagnostic, Files, Material, MaterialId, Scene};

/// Looks at the lines of an OBJ file before `tobj` reads them: it knows the materials and the
/// groups in force, and what is not understood.
pub(super) struct Reader<'f> {
    files: Files<'f>,
    pub(super) scene: Scene,
    pub(super) sections: Sections,
    materials: HashMap<String, MaterialId>,
    libraries: BTreeSet<String>,
    material: Option<MaterialId>,
    counts: Counts,
    /// What warnings have named already.
    ignored: BTreeSet<String>,
    /// Those of the face at hand.
    corners: Vec<Corner>,
}

impl<'f> Reader<'f> {
    pub(super) fn new(files: Files<'f>) -> Self {
        Self {
            files,
            scene: Scene::default(),
            sections: Sections::default(),
            materials: HashMap::new(),
            libraries: BTreeSet::new(),
            material: None,
            counts: Counts::default(),
            ignored: BTreeSet::new(),
            corners: Vec::new(),
        }
    }

    fn vertex<'a>(&mut self, line: &mut Line<'_>, text: Cow<'a, str>, handed: &mut Handed<'a>) {
        self.counts.positions += 1;
        // Three coordinates and a weight; with more they are colours.
        let words = [(); 5].map(|()| line.word());
        if words[4].is_some() {
            self.ignore("v", line, "has vertex colours, which were ignored");
            let coordinates: Vec<&str> = words.into_iter().flatten().take(3).collect();
            handed.line(format!("v {}", coordinates.join(" ")));
        } else {
            handed.line(text);
        }
    }

    fn face<'a>(
        &mut self,
        line: &mut Line<'_>,
        text: Cow<'a, str>,
        handed: &mut Handed<'a>,
    ) -> Result<(), Diagnostic> {
        let mut corners = core::mem::take(&mut self.corners);
        corners.clear();
        while let Some(word) = line.word() {
            corners.push(Corner::parse(word, self.counts, line)?);
        }
        if corners.len() < 3 {
            let found = corners.len();
            let message = format!("expected at least three corners, found {found}");
            return Err(line.diagnostic(message));
        }
        let first = corners[0];
        if corners.iter().any(|c| c.attributes() != first.attributes()) {
            let message = "expected all corners alike: v, v/vt, v//vn or v/vt/vn";
            return Err(line.diagnostic(message));
        }
        let lacks_normals = corners.iter().any(Corner::lacks_normal);
        let material = self.current_material();
        if let Some(section) = self.sections.change(material, first) {
            handed.before(format!("o {section}"));
        }
        if lacks_normals {
            let what = "names normals, of which there are none: its faces are flat";
            self.ignore("f", line, what);
            let words: Vec<String> = corners.iter().map(Corner::without_normal).collect();
            handed.line(format!("f {}", words.join(" ")));
        } else {
            handed.line(text);
        }
        self.corners = corners;
        Ok(())
    }

    /// The material in force, which is grey if the file named none.
    fn current_material(&mut self) -> MaterialId {
        let scene = &mut self.scene;
        let material = &mut self.material;
        *material.get_or_insert_with(|| {
            scene.add_material(Material::diffuse("default", Vec3::splat(0.5)))
        })
    }

    /// The material of this name; grey, with a warning, if no library has it.
    fn named_material(&mut self, name: String, line: &Line<'_>) -> MaterialId {
        if let Some(&id) = self.materials.get(&name) {
            return id;
        }
        let why = if self.libraries.is_empty() {
            "no `mtllib` line before".to_owned()
        } else {
            let libraries: Vec<&str> = self.libraries.iter().map(String::as_str).collect();
            format!("it is not in {}", libraries.join(", "))
        };
        let message = format!("material `{name}` is grey: {why}");
        self.scene.warnings.push(line.diagnostic(message));
        let grey = Material::diffuse(name.clone(), Vec3::splat(0.5));
        let id = self.scene.add_material(grey);
        self.materials.insert(name, id);
        id
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
        if !self.libraries.insert(name.to_owned()) {
            return Ok(());
        }
        let file = library_path(name, line);
        let bytes = match self.files.read(&file) {
            Ok(bytes) => bytes,
            Err(error) => {
                let what = format!("material library `{name}`: {}", error.message);
                let message = format!("{what}; its materials are grey");
                self.scene.warnings.push(line.diagnostic(message));
                return Ok(());
            }
        };
        let known = mtl::parse_mtl(&file, &text_of(&bytes), self.files, &mut self.scene)?;
        self.materials.extend(known);
        Ok(())
    }

    fn ignore(&mut self, keyword: &str, line: &Line<'_>, what: &str) {
        if self.ignored.insert(keyword.to_owned()) {
            let message = format!("`{keyword}` {what}");
            self.scene.warnings.push(line.diagnostic(message));
        }
    }
}

impl Cleaner for Reader<'_> {
    fn clean<'a>(
        &mut self,
        mut line: Line<'_>,
        text: Cow<'a, str>,
        handed: &mut Handed<'a>,
    ) -> Result<(), Diagnostic> {
        let Some(keyword) = line.word() else {
            return Ok(());
        };
        match keyword {
            "v" => self.vertex(&mut line, text, handed),
            "vt" => {
                self.counts.uvs += 1;
                // A curve has one coordinate.
                let is_flat = line.word().is_some() && line.word().is_none();
                if is_flat {
                    handed.line(format!("{text} 0"));
                } else {
                    handed.line(text);
                }
            }
            "vn" => {
                self.counts.normals += 1;
                handed.line(text);
            }
            "f" => self.face(&mut line, text, handed)?,
            "o" | "g" => self
                .sections
                .begin_group(line.rest("a name").unwrap_or_default()),
            "usemtl" => {
                let name = line.rest("a material's name")?;
                self.material = Some(self.named_material(name, &line));
            }
            "mtllib" => self.load_libraries(&mut line)?,
            // Smoothing groups: files that want smooth shading give normals.
            "s" => {}
            other => self.ignore(other, &line, "is not understood and was ignored"),
        }
        Ok(())
    }
}

/// Where a library is, whose name starts from the folder of the OBJ file.
fn library_path(name: &str, line: &Line<'_>) -> PathBuf {
    // Files from other systems separate folders with backslashes.
    line.path().with_file_name(name.replace('\\', "/"))
}
