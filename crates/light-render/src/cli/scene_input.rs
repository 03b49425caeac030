use std::path::{Path, PathBuf};

use crate::World;
use clap::Args;
use light_scene::{BuiltinScene, Diagnostic, Emission, Scene, read_environment};
use lights::glam::Affine3A;

use super::arguments::Emit;
use super::failure::Failure;
use super::light_args::LightArgs;
use super::stdout::complain;

/// Which scene, and what is changed in it.
#[derive(Args, Debug)]
pub(crate) struct SceneInput {
    /// The scene: an .obj, .pbrt, .gltf or .glb file, or the name of a scene that ships.
    pub(crate) scene: PathBuf,
    /// A lat-long environment around the scene: .exr or .hdr.
    #[arg(long, value_name = "IMAGE")]
    pub(crate) env: Option<PathBuf>,
    #[command(flatten)]
    light: LightArgs,
    /// Let the front of a material emit light with this radiance; may be repeated.
    #[arg(long, value_name = "MATERIAL=r,g,b")]
    pub(crate) emit: Vec<Emit>,
}

impl SceneInput {
    /// A scene with this environment and these materials turned on.
    pub(crate) fn new(scene: PathBuf, env: Option<PathBuf>, emit: Vec<Emit>) -> Self {
        Self {
            scene,
            env,
            light: LightArgs::default(),
            emit,
        }
    }

    /// Reads the scene with all that belongs to it.
    ///
    /// # Errors
    /// When a file cannot be read or is invalid.
    pub(crate) fn read(&self) -> Result<Scene, Failure> {
        let mut scene = read_scene(&self.scene)?;
        if let Some(path) = &self.env {
            let file = read_environment(path).map_err(Failure::input)?;
            scene.warnings.extend(file.warning);
            scene
                .add_sky(&file.image, Affine3A::IDENTITY)
                .map_err(Failure::input)?;
        }
        for Emit { material, radiance } in &self.emit {
            let mut named = scene
                .materials
                .iter_mut()
                .filter(|m| m.name == *material)
                .peekable();
            if named.peek().is_none() {
                let message = format!("--emit: expected the name of a material, found {material}");
                return Err(Failure::input(Diagnostic::file(&self.scene, message)));
            }
            named.for_each(|m| m.emission = Some(Emission::one_sided(*radiance)));
        }
        self.light.apply(&self.scene, &mut scene);
        Ok(scene)
    }

    /// Lights a scene in which nothing gives light; what was done, in words.
    pub(crate) fn light_the_dark(&self, scene: &mut Scene) -> Option<String> {
        self.light.light_the_dark(&self.scene, scene)
    }

    /// Makes a scene ready for rays.
    ///
    /// # Errors
    /// When a light is invalid.
    pub(crate) fn build(&self, scene: Scene) -> Result<World, Failure> {
        World::new(scene)
            .map_err(|error| Failure::input(Diagnostic::file(&self.scene, error.to_string())))
    }
}

/// The scene in a file, by the ending of its name, or the one that ships under a name without
/// ending.
fn read_scene(path: &Path) -> Result<Scene, Failure> {
    if path.extension().is_some() {
        return light_scene::read_scene(path).map_err(Failure::input);
    }
    let shipped = path.to_string_lossy().parse::<BuiltinScene>();
    shipped.map(BuiltinScene::load).map_err(|error| {
        let message = format!("expected a scene file, .obj, .pbrt, .gltf or .glb; or {error}");
        Failure::input(Diagnostic::file(path, message))
    })
}

/// Prints to standard error what the readers repaired or left out.
pub(crate) fn report_warnings(warnings: &[Diagnostic]) {
    for warning in warnings {
        complain(format_args!("warning: {warning}"));
    }
}
