//! What is said of lights that cannot be built, or not be chosen from.

use std::path::Path;

use light_scene::{Diagnostic, Scene};
use lights::sources::{LightDesc, LightDescError};

use super::failure::Failure;
use super::scene_input::SceneInput;
use crate::{AnyLightSamplerError, SceneLightsError, World, WorldError};

impl SceneInput {
    /// Makes a scene ready for rays.
    ///
    /// # Errors
    /// When a light is invalid. The message names the flag that scaled it, if there is one, and the
    /// file of an environment.
    pub(crate) fn build(&self, scene: Scene) -> Result<World, Failure> {
        let is_image = |light: &LightDesc<_>| matches!(light, LightDesc::ImageInfinite(_));
        // That of --env is the last one.
        let env = scene.lights.iter().rposition(is_image);
        World::new(scene).map_err(|error| self.refuse_world(&error, env))
    }

    fn refuse_world(&self, error: &WorldError, env: Option<usize>) -> Failure {
        let (is_sky, light) = match error {
            WorldError::Lights(SceneLightsError::Light { name, error }) => {
                (is_of_sky(error), Some((name, error)))
            }
            WorldError::Lights(SceneLightsError::Placement { .. }) => (false, None),
            _ => return self.refuse_scene(error.to_string()),
        };
        let scaled = self.changes.light.scale_flag(is_sky);
        let scaled = scaled.map_or_else(String::new, |flag| format!("{flag}: "));
        match (&self.changes.env, light, env) {
            (Some(path), Some((name, error)), Some(env)) if *name == format!("light {env}") => {
                refuse_file(path, format!("{scaled}{error}"))
            }
            _ => self.refuse_scene(format!("{scaled}{error}")),
        }
    }

    /// What is said where lights of the scene cannot be chosen from.
    pub(super) fn refuse_choice(&self, error: &AnyLightSamplerError) -> Failure {
        self.refuse_scene(error.to_string())
    }

    fn refuse_scene(&self, message: String) -> Failure {
        refuse_file(&self.scene, message)
    }
}

fn refuse_file(path: &Path, message: String) -> Failure {
    Failure::input(Diagnostic::file(path, message))
}

/// Whether a light is a sky or a sun, as [`LightDesc::is_sky`] says.
const fn is_of_sky(error: &LightDescError) -> bool {
    matches!(
        error,
        LightDescError::Sun(_)
            | LightDescError::UniformInfinite(_)
            | LightDescError::ImageInfinite(_)
            | LightDescError::PortalInfinite(_)
    )
}
