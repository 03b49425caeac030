use alloc::collections::BTreeSet;

use super::accessor::Budget;
use super::buffers::Buffers;
use super::document::Document;
use super::item::Item;
use super::known_materials::Materials;
use super::mesh_uses::MeshUses;
use super::texture_images::Textures;
use crate::{Diagnostic, Files, Scene};

/// Extensions that a document may require.
const KNOWN: [&str; 8] = [
    "EXT_lights_ies",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// The state of reading a document.
pub(super) struct Reader<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: Buffers<'a>,
    pub(super) budget: Budget,
    pub(super) scene: Scene,
    pub(super) textures: Textures,
    pub(super) materials: Materials,
    pub(super) uses: MeshUses<'a>,
    /// How many the document holds so far.
    pub(super) triangles: usize,
    warned: BTreeSet<String>,
}

impl<'a> Reader<'a> {
    /// A reader of a document, after its version, required extensions and buffers were checked.
    pub(super) fn new(
        document: &'a Document,
        binary: Option<&[u8]>,
        files: Files<'a>,
    ) -> Result<Self, Diagnostic> {
        let root = document.root();
        let version = root.require("asset")?.require("version")?;
        if !version.text()?.starts_with("2.") {
            return Err(version.expected("version 2.0"));
        }
        for required in root.list("extensionsRequired")? {
            if !KNOWN.contains(&required.text()?) {
                return Err(required.expected("an extension that is read"));
            }
        }
        // Each use is checked where it occurs.
        root.get("extensionsUsed")?;
        Ok(Self {
            document,
            buffers: Buffers::new(document, binary, files)?,
            budget: Budget::default(),
            scene: Scene::default(),
            textures: Textures::default(),
            materials: Materials::default(),
            uses: MeshUses::default(),
            triangles: 0,
            warned: BTreeSet::new(),
        })
    }

    /// The scene.
    pub(super) fn read(mut self) -> Result<Scene, Diagnostic> {
        self.nodes()?;
        self.add_instances()?;
        for item in self.document.unasked() {
            self.warn(&item, "was ignored");
        }
        Ok(self.scene)
    }

    /// Adds a warning about a part of the document, once for each kind of part.
    pub(super) fn warn(&mut self, item: &Item<'_>, message: &str) {
        if self.warned.insert(format!("{} {message}", item.kind())) {
            self.scene.warnings.push(item.error(message));
        }
    }
}
