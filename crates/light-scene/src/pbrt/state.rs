use alloc::collections::BTreeMap;
use alloc::rc::Rc;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

use lights::sources::{Image as LightImage, MediumInterface};

use super::attribute_target::Attributes;
use super::file_loc::FileLoc;
use super::image_key::ImageKey;
use super::included::Included;
use super::light_check::FarLight;
use super::material_names::NamedMaterials;
use super::medium_slot::MediumSlot;
use super::object_slots::Objects;
use super::parameters::Parameters;
use super::texture_kind::Textures;
use crate::glam::{Mat4, Vec3};
use crate::image::TexelBudget;
use crate::{Camera, Color, Crop, Diagnostic, Files, ImageId, Material, MaterialId, Scene};

/// The most open blocks of one kind.
pub(super) const MOST_BLOCKS: usize = 1 << 16;

/// What happens to things under a transform without an inverse.
pub(super) const FLATTENED: &str = "under a transform that cannot be inverted was left out";

/// The scene so far, and the state that the next directive acts on.
#[derive(Debug, Default)]
pub(super) struct Reader {
    pub(super) files: Files<'static>,
    /// The first file: names of others start from its folder, whoever names them.
    pub(super) root: PathBuf,
    pub(super) scene: Scene,
    pub(super) state: State,
    pub(super) saved: Vec<Saved<State>>,
    pub(super) saved_transforms: Vec<Saved<Mat4>>,
    pub(super) included: Included,
    /// How many there are so far.
    pub(super) triangles: usize,
    /// The images of lights, each file read once.
    pub(super) light_images: HashMap<PathBuf, LightImage>,
    /// Lights at infinity, whose power depends on the size of the scene.
    pub(super) far_lights: Vec<FarLight>,
    pub(super) coordinates: HashMap<String, Mat4>,
    pub(super) materials: NamedMaterials,
    pub(super) textures: Textures,
    /// Whether a texture that was not read was asked for.
    pub(super) met_stand_in: bool,
    /// Each file read once.
    pub(super) images: HashMap<ImageKey, ImageId>,
    /// What the images of surfaces and lights have together.
    pub(super) texels: TexelBudget,
    pub(super) media: Vec<MediumSlot>,
    pub(super) media_by_name: HashMap<String, usize>,
    /// All that `Attribute` directives have said, and where.
    pub(super) attributes: Vec<(PathBuf, Rc<Parameters>)>,
    /// The twins of materials that bound media.
    pub(super) interfaces: HashMap<(MaterialId, MediumInterface), MaterialId>,
    pub(super) objects: Objects,
    pub(super) camera: Option<Camera>,
    pub(super) resolution: Option<[u32; 2]>,
    pub(super) crop: Option<Crop>,
    pub(super) in_world: bool,
    /// Whether a directive is one that only pbrt-v3 has.
    pub(super) is_version_3: bool,
    /// The kinds of warnings so far: the place of the first of each in the list, and how many.
    warned: BTreeMap<String, (usize, usize)>,
}

/// What a directive has saved for the one that ends its block.
#[derive(Debug)]
pub(super) struct Saved<T> {
    pub(super) state: T,
    /// The error if nothing ends it.
    unclosed: Diagnostic,
}

/// The state that `AttributeBegin` saves.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub(super) transform: Mat4,
    /// Whether transforms act on the start of a motion, which the picture shows.
    pub(super) is_active: bool,
    pub(super) material: Option<MaterialId>,
    pub(super) area_light: Option<AreaLight>,
    pub(super) reversed: bool,
    pub(super) media: MediumInterface,
    pub(super) attributes: Attributes,
}

/// An `AreaLightSource`.
#[derive(Clone, Copy, Debug)]
pub(super) struct AreaLight {
    pub(super) radiance: Color,
    pub(super) two_sided: bool,
    /// The factor of the radiance that gives one side of a surface of area 1 the stated power, if
    /// the file states one.
    pub(super) of_unit_area: Option<f32>,
}

impl State {
    /// Whether the transform makes space flat, so that it cannot be inverted.
    pub(super) fn is_singular(&self) -> bool {
        !self.transform.inverse().is_finite()
    }
}

impl Default for State {
    fn default() -> Self {
        Self {
            transform: Mat4::IDENTITY,
            is_active: true,
            material: None,
            area_light: None,
            reversed: false,
            media: MediumInterface::default(),
            attributes: Attributes::default(),
        }
    }
}

impl Reader {
    /// Whether the transform mirrors.
    pub(super) fn mirrors(&self) -> bool {
        self.state.transform.determinant() < 0.0
    }

    /// The current material, grey if the file named none.
    pub(super) fn material(&mut self) -> MaterialId {
        let scene = &mut self.scene;
        let make = || scene.add_material(Material::diffuse("default", Vec3::splat(0.5)));
        *self.state.material.get_or_insert_with(make)
    }

    /// Saves the state for a directive that ends the block, or what to say if there is none.
    pub(super) fn save_state(&mut self, at: FileLoc<'_>, unclosed: &str) -> Result<(), Diagnostic> {
        let state = self.state.clone();
        save(&mut self.saved, at, state, unclosed)
    }

    pub(super) fn save_transform(&mut self, at: FileLoc<'_>) -> Result<(), Diagnostic> {
        let unclosed = "expected `TransformEnd` after `TransformBegin`";
        save(
            &mut self.saved_transforms,
            at,
            self.state.transform,
            unclosed,
        )
    }

    /// How many blocks of both kinds are open.
    pub(super) fn open_blocks(&self) -> [usize; 2] {
        [self.saved.len(), self.saved_transforms.len()]
    }

    /// Adds a warning with a location, once for each `what`; how often it came is counted.
    pub(super) fn warn(&mut self, at: FileLoc<'_>, what: &str, message: &str) {
        self.warn_kind(at, what, what, message);
    }

    /// As [`warn`](Self::warn), once for each `kind`: of names that the file has chosen only the
    /// first is shown.
    pub(super) fn warn_kind(&mut self, at: FileLoc<'_>, kind: &str, what: &str, message: &str) {
        let warnings = &mut self.scene.warnings;
        let (_, count) = self.warned.entry(kind.to_owned()).or_insert_with(|| {
            warnings.push(at.diagnostic(format!("{what} {message}")));
            (warnings.len() - 1, 0)
        });
        *count += 1;
    }

    /// Adds to each warning how many others of its kind there are.
    fn count_warnings(&mut self) {
        for (index, count) in core::mem::take(&mut self.warned).into_values() {
            if count > 1 {
                let others = count - 1;
                let message = &mut self.scene.warnings[index].message;
                message.push_str(&format!(" (and {others} more like it)"));
            }
        }
    }

    /// Adds a warning for the unread parameters of a directive.
    pub(super) fn warn_unused(
        &mut self,
        at: FileLoc<'_>,
        directive: &str,
        parameters: &Parameters,
    ) {
        for (name, line) in parameters.unused() {
            let at = FileLoc { line, ..at };
            let what = format!("{directive}: parameter `{name}`");
            self.warn(at, &what, "was ignored");
        }
    }

    /// Where a file is that a directive names.
    pub(super) fn resolve(&self, name: &str) -> PathBuf {
        self.root.with_file_name(name)
    }

    /// The scene, once all files are read.
    pub(super) fn finish(mut self, path: &Path) -> Result<Scene, Diagnostic> {
        if !self.in_world {
            return Err(Diagnostic::file(path, "expected `WorldBegin`"));
        }
        let unclosed = self.saved.pop().map(|saved| saved.unclosed);
        let transform = self.saved_transforms.pop().map(|saved| saved.unclosed);
        if let Some(unclosed) = unclosed.or(transform) {
            return Err(unclosed);
        }
        self.finish_materials()?;
        self.warn_unused_attributes();
        self.scene.media = self.finished_media()?;
        self.scene.prototypes = self.finished_objects()?;
        let far_lights = core::mem::take(&mut self.far_lights);
        if !far_lights.is_empty() {
            let fault = FarLight::fault_of(far_lights, &self.scene.bounds());
            fault.map_or(Ok(()), Err)?;
        }
        // A film without a camera is that of the program's own.
        let own = || self.resolution.map(|_| self.scene.camera_or_default());
        self.scene.camera = self.camera.or_else(own).map(|camera| Camera {
            resolution: self.resolution,
            crop: self.crop,
            ..camera
        });
        self.count_warnings();
        Ok(self.scene)
    }
}

fn save<T>(
    all: &mut Vec<Saved<T>>,
    at: FileLoc<'_>,
    state: T,
    unclosed: &str,
) -> Result<(), Diagnostic> {
    if all.len() == MOST_BLOCKS {
        let message = format!("expected at most {MOST_BLOCKS} blocks in each other");
        return Err(at.diagnostic(message));
    }
    let unclosed = at.diagnostic(unclosed);
    all.push(Saved { state, unclosed });
    Ok(())
}
