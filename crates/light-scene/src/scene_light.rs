//! How much light a scene has, and changing it.

use core::mem;

use crate::glam::Vec3;
use crate::{Color, Scene};

impl Scene {
    /// Whether it has lights: a light of its list, a material of a mesh or a sphere that emits, a
    /// medium, which may glow, or black lights in the file.
    #[must_use]
    pub fn is_lit(&self) -> bool {
        let meshes = self.prototypes.iter().map(|prototype| &prototype.meshes);
        let meshes = meshes.chain([&self.meshes]).flatten();
        let quadrics = self.prototypes.iter().map(|prototype| &prototype.quadrics);
        let quadrics = quadrics.chain([&self.quadrics]).flatten();
        let materials = meshes.map(|mesh| mesh.material);
        let mut used = materials.chain(quadrics.map(|sphere| sphere.material));
        let is_listed = !self.lights.is_empty() || self.has_black_lights;
        is_listed || !self.media.is_empty() || used.any(|id| self.is_emissive(id))
    }

    /// Removes all skies and suns, as [`LightDesc::is_sky`](lights::sources::LightDesc::is_sky)
    /// says.
    pub fn remove_skies(&mut self) {
        self.light_names.resize(self.lights.len(), String::new());
        let named = mem::take(&mut self.lights)
            .into_iter()
            .zip(mem::take(&mut self.light_names));
        (self.lights, self.light_names) = named.filter(|(light, _)| !light.is_sky()).unzip();
    }

    /// Makes all skies and suns `factor` times as bright. Own lights stay as they are.
    pub fn scale_skies(&mut self, factor: f32) {
        for light in self.lights.iter_mut().filter(|light| light.is_sky()) {
            light.scale(factor);
        }
    }

    /// Makes all other lights and all emissive materials `factor` times as bright. Own lights and
    /// media stay as they are.
    pub fn scale_lamps(&mut self, factor: f32) {
        for light in self.lights.iter_mut().filter(|light| !light.is_sky()) {
            light.scale(factor);
        }
        for material in &mut self.materials {
            if let Some(emission) = &mut material.emission {
                emission.radiance = scaled(emission.radiance, Vec3::splat(factor));
            }
        }
    }
}

/// A colour times a factor.
pub(crate) fn scaled(color: Color, by: Vec3) -> Color {
    match color {
        Color::Constant(color) => Color::Constant(color * by),
        Color::Image(mut shown) => {
            shown.scale *= by;
            Color::Image(shown)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BuiltinSky, Emission, Material, Mesh};
    use lights::sources::{LightDesc, PointLightDesc};

    /// A lamp of a mesh, a point light, and a sky.
    fn scene() -> Scene {
        let mut scene = Scene::default();
        let lamp = scene.add_material(Material {
            emission: Some(Emission::one_sided(Vec3::ONE)),
            ..Material::diffuse("lamp", Vec3::ZERO)
        });
        let corners = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
        scene.meshes.push(Mesh::quad("lamp", lamp, corners));
        let point = LightDesc::Point(PointLightDesc {
            position: Vec3::ZERO,
            emission: Vec3::ONE,
            amount: Default::default(),
            media: Default::default(),
        });
        BuiltinSky::ClearNoon.add_to(&mut scene, Vec3::Y);
        scene.add_named_light("bulb", point);
        scene
    }

    fn amounts(scene: &Scene) -> Vec<f32> {
        let digits = |light: &LightDesc<_>| {
            let text = format!("{light:?}");
            let (_, after) = text.rsplit_once("Radiometric(").expect("an amount");
            let (number, _) = after.split_once(')').expect("a number");
            number.parse().expect("a number")
        };
        scene.lights.iter().map(digits).collect()
    }

    #[test]
    fn skies_and_lamps_are_scaled_apart() {
        let before = amounts(&scene());
        let mut scene = scene();
        scene.scale_skies(2.0);
        scene.scale_lamps(3.0);
        let factors: Vec<f32> = amounts(&scene)
            .iter()
            .zip(&before)
            .map(|(a, b)| a / b)
            .collect();
        assert_eq!(factors, [2.0, 2.0, 3.0], "the sky, its sun, the bulb");
        let radiance = scene.materials[0].emission.expect("emission").radiance;
        assert_eq!(radiance, Color::Constant(Vec3::splat(3.0)), "the lamp");
    }

    #[test]
    fn skies_are_removed_with_their_names() {
        let mut scene = scene();
        scene.remove_skies();
        assert_eq!(scene.lights.len(), 1, "the bulb");
        assert_eq!(scene.light_names, ["bulb"], "and its name");
    }

    #[test]
    fn scenes_are_lit_by_what_is_used() {
        let mut scene = scene();
        scene.lights.clear();
        assert!(scene.is_lit(), "by the lamp");
        scene.meshes.clear();
        assert!(!scene.is_lit(), "a material alone gives no light");
        scene.has_black_lights = true;
        assert!(scene.is_lit(), "as dark as the file wants it");
    }
}
