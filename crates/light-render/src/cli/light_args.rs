use std::path::Path;

use clap::Args;
use light_scene::{BuiltinSky, Diagnostic, Scene};
use lights::glam::Vec3;
use lights::sources::LightDesc;

use super::arguments::{named, positive};
use super::output_file::has_ending;

/// What is changed in a scene's light.
#[derive(Args, Clone, Debug)]
pub(crate) struct LightArgs {
    /// A sky that the program brings along, in place of those of the scene: white all around, blue
    /// with the sun 60 degrees high, or grey clouds.
    #[arg(
        long,
        value_name = "NAME",
        value_parser = named::<BuiltinSky>(BuiltinSky::ALL.map(BuiltinSky::name)),
        conflicts_with = "env",
        requires = "scene"
    )]
    sky: Option<BuiltinSky>,
    /// Make skies and suns so many times as bright.
    #[arg(long, value_name = "FACTOR", value_parser = positive, requires = "scene")]
    env_scale: Option<f32>,
    /// Make all other lights so many times as bright.
    #[arg(long, value_name = "FACTOR", value_parser = positive, requires = "scene")]
    light_scale: Option<f32>,
}

impl LightArgs {
    /// The sky of a scene that has no light.
    const OF_THE_DARK: BuiltinSky = BuiltinSky::Overcast;

    /// Changes the light of a scene, which was read from `path`.
    pub(crate) fn apply(&self, path: &Path, scene: &mut Scene) {
        if let Some(sky) = self.sky {
            scene.remove_skies();
            sky.add_to(scene, up(path, scene));
        }
        self.doubt_scales(path, scene);
        if let Some(factor) = self.env_scale {
            scene.scale_skies(factor);
        }
        if let Some(factor) = self.light_scale {
            scene.scale_lamps(factor);
        }
    }

    /// The flag that makes skies, or all other lights, brighter or darker, as it was given.
    pub(super) fn scale_flag(&self, of_skies: bool) -> Option<String> {
        let (flag, factor) = if of_skies {
            ("--env-scale", self.env_scale)
        } else {
            ("--light-scale", self.light_scale)
        };
        Some(format!("{flag} {:?}", factor?))
    }

    /// Adds a warning for each scale that no light of `scene` has.
    fn doubt_scales(&self, path: &Path, scene: &mut Scene) {
        let has_sky = scene.lights.iter().any(LightDesc::is_sky);
        let has_lamp = scene.lights.iter().any(|light| !light.is_sky())
            || scene.materials.iter().any(|m| m.emission.is_some());
        // A scene without any light gets a sky.
        let lacks_sky = self.env_scale.is_some() && !has_sky && scene.is_lit();
        let lacks_lamp = self.light_scale.is_some() && !has_lamp;
        let words = [
            (
                lacks_sky,
                "--env-scale has no effect: there is no sky and no sun",
            ),
            (
                lacks_lamp,
                "--light-scale has no effect: there are no lights but skies and suns",
            ),
        ];
        let words = words.into_iter().filter(|(is_lacking, _)| *is_lacking);
        let warnings = words.map(|(_, words)| Diagnostic::file(path, words));
        scene.warnings.extend(warnings);
    }

    /// Lights a scene in which nothing gives light; what was done, in words.
    pub(crate) fn light_the_dark(&self, path: &Path, scene: &mut Scene) -> Option<String> {
        if scene.is_lit() {
            return None;
        }
        let sky = Self::OF_THE_DARK;
        sky.add_to(scene, up(path, scene));
        if let Some(factor) = self.env_scale {
            scene.scale_skies(factor);
        }
        Some(format!(
            "no light in the scene: it is shown under the built-in sky `{sky}` (--sky names \
             another, --env an image)"
        ))
    }
}

/// What is up: y, but in a pbrt file the axis that is nearest to what is up in its picture.
pub(super) fn up(path: &Path, scene: &Scene) -> Vec3 {
    let camera = scene.camera.filter(|_| has_ending(path, "pbrt"));
    let Some(up) = camera.map(|camera| camera.up) else {
        return Vec3::Y;
    };
    let axis = up.abs().max_position();
    Vec3::AXES[axis] * up[axis].signum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_scene::Camera;

    #[test]
    fn up_is_y_but_in_files_of_pbrt() {
        let mut scene = Scene::default();
        let up_of = |name: &str, scene: &Scene| up(Path::new(name), scene);
        assert_eq!(up_of("a.pbrt", &scene), Vec3::Y, "no camera");
        let eye = Vec3::new(5.0, 4.0, 2.0);
        for (axis, expected) in [(Vec3::Z, Vec3::Z), (Vec3::NEG_Y, Vec3::NEG_Y)] {
            scene.camera = Camera::look_at(eye, Vec3::ZERO, axis, 1.0).ok();
            assert_eq!(up_of("a.pbrt", &scene), expected, "of its camera");
            assert_eq!(up_of("a.glb", &scene), Vec3::Y, "as the format says");
        }
    }
}
