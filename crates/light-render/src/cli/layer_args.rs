use clap::{Args, ValueEnum};
use light_scene::Diagnostic;

use crate::integrator::Integrator;
use crate::{LightGroupPattern, LightLayers, RenderSettings, View, World};

use super::failure::Failure;
use super::memory_check::{PICTURE, check_memory};
use super::scene_input::SceneInput;

/// Layers of a picture.
#[derive(Args, Debug)]
pub(crate) struct LayerArgs {
    /// Write layers beside the picture into .exr files: one a group of lights (groups), the sum of
    /// which is the picture.
    #[arg(long, value_enum, conflicts_with_all = ["samples", "checkpoint", "half"])]
    aov: Option<Aov>,
    /// A group of lights: those whose material, object, node or kind of light has a name like
    /// PATTERN, in which * stands for any text; may be repeated. A light is in the first that fits.
    /// Without it each material and each named light is a group, and each kind of other lights.
    #[arg(long, value_name = "NAME=PATTERN", requires = "aov")]
    group: Vec<LightGroupPattern>,
}

/// What layers hold.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Aov {
    Groups,
}

impl LayerArgs {
    /// Whether layers are requested.
    pub(crate) const fn is_wanted(&self) -> bool {
        self.aov.is_some()
    }

    /// The layers of a picture of `view`; none if they are not requested.
    ///
    /// # Errors
    /// When a group has no light, there are too many, the integrator does not separate lights, or
    /// the layers do not fit into memory.
    pub(crate) fn layers(
        &self,
        input: &SceneInput,
        world: &World,
        view: &View,
        settings: &RenderSettings,
    ) -> Result<Option<LightLayers>, Failure> {
        if !self.is_wanted() {
            return Ok(None);
        }
        if matches!(settings.path.integrator, Integrator::SingleScattering(_)) {
            let message = "--aov groups: expected --integrator path or volpath";
            return Err(Failure::Input(message.into()));
        }
        let layers = LightLayers::new(world, &self.group)
            .map_err(|error| Failure::input(Diagnostic::file(&input.scene, error.to_string())))?;
        let (width, height) = view.crop().size();
        let count = layers.names().len() as u64;
        let what =
            format!("{count} layers of {width} x {height} pixels (--aov, --width, --height)");
        let pixels = u64::from(width) * u64::from(height);
        check_memory(&what, pixels * (count + 1) * PICTURE)?;
        Ok(Some(layers))
    }
}
