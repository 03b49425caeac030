use super::accessor::Budget;
use super::buffers::Buffers;
use super::document::Document;
use super::glb::UPGRADE;
use super::item::Item;
use super::known_materials::Materials;
use super::mesh_uses::MeshUses;
use super::required_extensions::{Required, UNPACK, required};
use super::texture_images::Textures;
use super::warnings::Warnings;
use crate::{Diagnostic, Files, Scene};

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
    /// Instances that an extension places, so far.
    pub(super) placed: usize,
    warnings: Warnings,
}

impl<'a> Reader<'a> {
    /// A reader of a document, after its version, required extensions and buffers were checked.
    pub(super) fn new(
        document: &'a Document,
        binary: Option<&[u8]>,
        files: Files<'a>,
    ) -> Result<Self, Diagnostic> {
        let root = document.root();
        let asset = root.require("asset")?;
        let version = asset.require("version")?;
        let number = version.text()?;
        if !number.starts_with("2.") {
            let mut error = version.expected("version 2.0");
            if number.starts_with("1.") {
                error.message += UPGRADE;
            }
            return Err(error);
        }
        if let Some(least) = asset.get("minVersion")? {
            if least.text()? != "2.0" {
                return Err(least.expected("version 2.0, the newest that is read"));
            }
        }
        let mut warnings = Warnings::default();
        for extension in root.list("extensionsRequired")? {
            match required(extension.text()?) {
                Required::Read => {}
                Required::Looks => warnings.add(
                    &extension,
                    "names an extension that is not read: the picture may look different",
                ),
                Required::Compressed => {
                    let mut error = extension.expected("meshes that are not compressed");
                    error.message += UNPACK;
                    return Err(error);
                }
                Required::Unknown => return Err(extension.expected("an extension that is read")),
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
            placed: 0,
            warnings,
        })
    }

    /// The scene.
    pub(super) fn read(mut self) -> Result<Scene, Diagnostic> {
        self.nodes()?;
        self.add_instances()?;
        for item in self.document.unvisited() {
            self.warnings.add(&item, "was ignored");
        }
        self.scene.warnings.splice(0..0, self.warnings.finish());
        Ok(self.scene)
    }

    /// Adds a warning about a part of the document, shown once for each kind of part.
    pub(super) fn warn(&mut self, item: &Item<'_>, message: &str) {
        self.warnings.add(item, message);
    }
}
