use std::fs;
use std::path::{Path, PathBuf};

use crate::World;
use clap::Args;
use light_scene::{BuiltinScene, Diagnostic, Emission, Scene, is_scene_name, recorded_read_files};
use lights::glam::{Affine3A, Quat, Vec3};

use super::arguments::{Emit, finite};
use super::environment::read_sky;
use super::failure::Failure;
use super::light_args::{LightArgs, up};
use super::output_file::{expect_another, refuse};
use super::stdout::{complain, report_warnings};

/// Which scene, and what is changed in it.
#[derive(Args, Debug)]
pub(crate) struct SceneInput {
    /// The scene: an .obj, .pbrt, .gltf or .glb file, or one that ships: cornell-box, rotunda, fog,
    /// night; or rooms, slabs, louvres, boxes, street, trunks, open, each also with -large.
    pub(crate) scene: PathBuf,
    #[command(flatten)]
    pub(crate) changes: SceneChanges,
}

/// What is changed in a scene, for commands with an argument `scene`.
#[derive(Args, Clone, Debug)]
pub(crate) struct SceneChanges {
    /// An environment around the scene: .exr, .hdr or .png; 2:1 is lat-long, a square is equal-area.
    #[arg(long, value_name = "IMAGE", requires = "scene")]
    pub(crate) env: Option<PathBuf>,
    /// Turn the environment so far about the upward axis, counter-clockwise as seen from above.
    #[arg(
        long,
        value_name = "DEGREES",
        value_parser = finite,
        allow_negative_numbers = true,
        requires = "env"
    )]
    env_rotate: Option<f32>,
    #[command(flatten)]
    pub(super) light: LightArgs,
    /// Let the front of a material emit light with this radiance; may be repeated.
    #[arg(long, value_name = "MATERIAL=r,g,b", requires = "scene")]
    emit: Vec<Emit>,
}

impl SceneInput {
    /// Reads the scene with all that belongs to it.
    ///
    /// # Errors
    /// When a file cannot be read or is invalid.
    pub(crate) fn read(&self) -> Result<Scene, Failure> {
        let SceneChanges {
            env,
            env_rotate,
            light,
            emit,
        } = &self.changes;
        let mut scene = read_scene(&self.scene)?;
        if let Some(path) = env {
            let (map, warnings) = read_sky(path)?;
            scene.warnings.extend(warnings);
            let up = up(&self.scene, &scene);
            let turn = Quat::from_axis_angle(up, env_rotate.unwrap_or(0.0).to_radians());
            let turned = Affine3A::from_quat(turn * Quat::from_rotation_arc(Vec3::Y, up));
            scene.add_environment(map, turned);
        }
        for Emit { material, radiance } in emit {
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
        light.apply(&self.scene, &mut scene);
        Ok(scene)
    }

    /// Reads the scene as [`read`](Self::read) does, and gives it a sky if nothing in it gives
    /// light. What the readers repaired and which sky it is go to standard error, unless
    /// `is_quiet`.
    ///
    /// # Errors
    /// When a file cannot be read or is invalid.
    pub(crate) fn read_lit(&self, is_quiet: bool) -> Result<Scene, Failure> {
        let mut scene = self.read()?;
        let sky = self.changes.light.light_the_dark(&self.scene, &mut scene);
        if !is_quiet {
            report_warnings(&scene.warnings);
            sky.iter()
                .for_each(|words| complain(format_args!("{words}")));
        }
        Ok(scene)
    }

    /// Makes sure that none of `outputs` is the scene or its environment.
    ///
    /// # Errors
    /// When one is.
    pub(crate) fn expect_outputs(&self, outputs: &[PathBuf]) -> Result<(), Failure> {
        let env = self.changes.env.iter();
        let inputs: Vec<PathBuf> = env.chain([&self.scene]).cloned().collect();
        outputs
            .iter()
            .try_for_each(|path| expect_another(path, &inputs, INPUTS))
    }

    /// Makes sure that none of `outputs` is a file that was opened since files are recorded, as the
    /// textures and meshes of a scene that was read.
    ///
    /// # Errors
    /// When one is.
    pub(crate) fn expect_unread(outputs: &[PathBuf]) -> Result<(), Failure> {
        let read = recorded_read_files();
        outputs
            .iter()
            .try_for_each(|path| expect_another(path, &read, INPUTS))
    }

    /// Makes sure that a scene of `world` has light.
    ///
    /// # Errors
    /// When no light of it is above 0.
    pub(crate) fn expect_light(&self, world: &World) -> Result<(), Failure> {
        if !world.lights().is_empty() {
            return Ok(());
        }
        let nothing = "no light in the scene is above 0: each is black, or of a surface without \
                       area; expected another, --env IMAGE or --sky NAME";
        Err(refuse(&self.scene, nothing))
    }

    /// Makes sure that each light of `world` can be looked at.
    ///
    /// # Errors
    /// When there are too many; `what` looks at each.
    pub(crate) fn expect_few_lights(&self, world: &World, what: &str) -> Result<(), Failure> {
        let lights = world.lights().len();
        if lights <= MOST_LIGHTS {
            return Ok(());
        }
        let message =
            format!("{what} looks at each light: expected at most {MOST_LIGHTS}, found {lights}");
        Err(refuse(&self.scene, message))
    }
}

/// What a scene is read from.
const INPUTS: &str = "the scene and its images";

/// The most lights of a scene that commands look at one by one, for some minutes.
const MOST_LIGHTS: usize = 1 << 25;

/// The scene in a file, by the ending of its name, or the one that ships under this name.
fn read_scene(path: &Path) -> Result<Scene, Failure> {
    if is_scene_name(path) {
        return light_scene::read_scene(path).map_err(Failure::input);
    }
    let shipped = path.to_string_lossy().parse::<BuiltinScene>();
    shipped.map(BuiltinScene::load).map_err(|error| {
        let message = match scene_in(path) {
            Some(file) => format!("is a folder; expected a file in it, as {}", file.display()),
            None => format!("expected a scene file, .obj, .pbrt, .gltf or .glb; or {error}"),
        };
        Failure::input(Diagnostic::file(path, message))
    })
}

/// The first scene file in a folder, by name.
fn scene_in(folder: &Path) -> Option<PathBuf> {
    let entries = fs::read_dir(folder).ok()?.flatten();
    let files = entries.map(|entry| entry.path());
    files.filter(|path| is_scene_name(path)).min()
}
