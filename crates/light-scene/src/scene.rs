use lights::media::AnyMedium;
use lights::sources::{
    self as sources, EnvironmentMap, ImageInfiniteLightDesc, LightDesc, MediumId, RadianceAmount,
    Rgb,
};

use crate::emissive_copies::EmissiveCount;
use crate::glam::{Affine3A, Vec3};
use crate::{
    Camera, Color, Diagnostic, Image, ImageId, Instance, Material, MaterialId, Mesh, NamedMedium,
    Prototype, PrototypeId, Quadric,
};

/// The content of a scene file, in the user's units: geometry, materials, lights, media, camera.
///
/// Right-handed, y up by convention; lengths are in scene units. A `Scene` is not validated (a
/// material may emit negative radiance); the lights built from it are.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Meshes in world space, one per group and material of the file.
    pub meshes: Vec<Mesh>,
    /// Spheres in world space.
    pub quadrics: Vec<Quadric>,
    /// Objects stored once; an instance names its prototype by position.
    pub prototypes: Vec<Prototype>,
    /// The instances of the prototypes.
    pub instances: Vec<Instance>,
    /// Materials; a mesh names its material by position.
    pub materials: Vec<Material>,
    /// Images, each stored once however often it is used.
    pub images: Vec<Image>,
    /// Lights beside those of emissive materials: points, spots, distant lights, environments. No
    /// reader makes area lights, mesh lights and own lights here; a program may add them.
    pub lights: Vec<LightDesc<Rgb>>,
    /// The names of these lights in the file, in their order; empty for a light without one, as for
    /// lights beyond the end.
    pub light_names: Vec<String>,
    /// Whether the file has lights that are black, which the reader left out: the scene is dark on
    /// purpose if it has no others.
    pub has_black_lights: bool,
    /// Media; materials and lights name them by position.
    pub media: Vec<NamedMedium>,
    /// The camera, if the file has one.
    pub camera: Option<Camera>,
    /// The medium that the camera is in; `None` for vacuum.
    pub camera_medium: Option<MediumId>,
    /// The segments of the longest path that the file asks for: 1 shows emitters, 2 adds direct
    /// light.
    pub max_depth: Option<u32>,
    /// The samples a pixel that the file asks for, at least 1.
    pub samples_per_pixel: Option<u32>,
    /// What the reader ignored or repaired, each with file and line.
    pub warnings: Vec<Diagnostic>,
}

impl Scene {
    /// The material with this id.
    ///
    /// # Panics
    /// Panics if the scene has no such material; readers never make such an id.
    #[must_use]
    pub fn material(&self, id: MaterialId) -> &Material {
        &self.materials[id.0 as usize]
    }

    /// The mean of a colour over the whole of its image.
    ///
    /// # Panics
    /// Panics if the scene has no such image; readers never make such a colour.
    #[must_use]
    pub fn mean(&self, color: &Color) -> Vec3 {
        match color {
            Color::Constant(color) => *color,
            Color::Image(shown) => shown.scale * self.images[shown.image.0 as usize].mean(),
        }
    }

    /// Adds a light without geometry, with the name that it has in the file.
    pub(crate) fn add_named_light(&mut self, name: &str, light: LightDesc<Rgb>) {
        self.light_names.resize(self.lights.len(), String::new());
        self.light_names.push(name.into());
        self.lights.push(light);
    }

    /// The prototype with this id.
    ///
    /// # Panics
    /// Panics if the scene has no such prototype; readers never make such an id.
    #[must_use]
    pub fn prototype(&self, id: PrototypeId) -> &Prototype {
        &self.prototypes[id.0 as usize]
    }

    /// The number of triangles, those of prototypes counted once per instance.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.count(|_| true)
    }

    /// The number of triangles of emissive materials, those of prototypes counted once per
    /// instance.
    #[must_use]
    pub fn emissive_triangle_count(&self) -> usize {
        self.count(|mesh| self.is_emissive(mesh.material))
    }

    /// Whether the material emits light.
    ///
    /// # Panics
    /// Panics if the scene has no such material; readers never make such an id.
    #[must_use]
    pub fn is_emissive(&self, material: MaterialId) -> bool {
        self.material(material).emission.is_some()
    }

    /// The emissive triangles and quadrics of a prototype.
    pub(crate) fn emissive_count(&self, prototype: &Prototype) -> EmissiveCount {
        let Prototype {
            meshes, quadrics, ..
        } = prototype;
        let meshes = meshes.iter().filter(|mesh| self.is_emissive(mesh.material));
        let quadrics = quadrics.iter().filter(|s| self.is_emissive(s.material));
        EmissiveCount {
            triangles: meshes.map(|mesh| mesh.indices.len()).sum(),
            quadrics: quadrics.count(),
        }
    }

    /// The number of triangles of the meshes that `counts` accepts, instances included.
    fn count(&self, counts: impl Fn(&Mesh) -> bool) -> usize {
        let of = |meshes: &[Mesh]| -> usize {
            let counted = meshes.iter().filter(|mesh| counts(mesh));
            counted.map(|mesh| mesh.indices.len()).sum()
        };
        let prototypes: Vec<usize> = self.prototypes.iter().map(|p| of(&p.meshes)).collect();
        let instances = self.instances.iter();
        let instanced: usize = instances.map(|p| prototypes[p.prototype.0 as usize]).sum();
        of(&self.meshes) + instanced
    }

    /// The scene's camera or, without one, a camera whose view contains the whole scene: raised,
    /// from the right of what is in front, with y up.
    #[must_use]
    pub fn camera_or_default(&self) -> Camera {
        let default = || Camera::framing(&self.bounds(), Vec3::new(-0.6, -0.45, -1.0));
        self.camera.unwrap_or_else(default)
    }

    /// Adds a material and returns its id.
    ///
    /// # Panics
    /// Panics if there are already 2^32 materials.
    pub fn add_material(&mut self, material: Material) -> MaterialId {
        let id = u32::try_from(self.materials.len()).expect("fewer than 2^32 materials");
        self.materials.push(material);
        MaterialId(id)
    }

    /// Adds a prototype without instances and returns its id.
    ///
    /// # Panics
    /// Panics if there are already 2^32 prototypes.
    pub fn add_prototype(&mut self, prototype: Prototype) -> PrototypeId {
        let id = u32::try_from(self.prototypes.len()).expect("fewer than 2^32 prototypes");
        self.prototypes.push(prototype);
        PrototypeId(id)
    }

    /// Adds a medium and returns its id.
    ///
    /// # Panics
    /// Panics if there are already 2^32 - 1 media.
    pub fn add_medium(
        &mut self,
        name: impl Into<String>,
        medium: impl Into<AnyMedium<Rgb>>,
    ) -> MediumId {
        let id = u32::try_from(self.media.len()).ok().and_then(MediumId::new);
        let (name, medium) = (name.into(), medium.into());
        self.media.push(NamedMedium { name, medium });
        id.expect("fewer than 2^32 - 1 media")
    }

    /// Puts a lat-long image around the scene, turned by the rotation in `transform`.
    ///
    /// Column u left to right, row v top to bottom, `t = pi v`, `p = 2 pi u`: direction
    /// (sin t sin p, cos t, -sin t cos p) before the rotation; the middle of the map looks to +z.
    ///
    /// # Errors
    /// When a texel is negative or not finite.
    pub fn add_sky(
        &mut self,
        image: &Image,
        transform: Affine3A,
    ) -> Result<(), sources::ImageError> {
        self.add_environment(EnvironmentMap::LatLong(image.to_light()?), transform);
        Ok(())
    }

    /// Puts a map around the scene, turned by the rotation in `transform`: a lat-long one as
    /// [`add_sky`](Self::add_sky) does, an equal-area one by the same directions.
    pub fn add_environment(&mut self, map: EnvironmentMap, transform: Affine3A) {
        let sky = ImageInfiniteLightDesc {
            transform,
            map,
            amount: RadianceAmount::default(),
        };
        self.lights.push(LightDesc::ImageInfinite(sky));
    }

    /// Adds an image and returns its id.
    ///
    /// # Panics
    /// Panics if there are already 2^32 images.
    pub fn add_image(&mut self, image: Image) -> ImageId {
        let id = u32::try_from(self.images.len()).expect("fewer than 2^32 images");
        self.images.push(image);
        ImageId(id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Emission;
    use lights::math::Aabb;

    #[test]
    fn counts_and_bounds() {
        let mut scene = Scene::default();
        let grey = scene.add_material(Material::diffuse("grey", Vec3::splat(0.5)));
        let lamp = scene.add_material(Material {
            emission: Some(Emission::one_sided(Vec3::ONE)),
            ..Material::diffuse("lamp", Vec3::ZERO)
        });
        let corners = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
        scene.meshes.push(Mesh::quad("floor", grey, corners));
        let above = corners.map(|p| p + Vec3::Z);
        scene.meshes.push(Mesh::quad("lamp", lamp, above));
        assert_eq!(scene.triangle_count(), 4, "two quads");
        assert_eq!(
            scene.emissive_triangle_count(),
            2,
            "one of them is emissive"
        );
        assert_eq!(scene.bounds(), Aabb::new(Vec3::ZERO, Vec3::ONE), "box");

        let lamps = vec![Mesh::quad("lamp", lamp, corners)];
        let prototype = scene.add_prototype(Prototype::new("lamps", lamps));
        assert_eq!(scene.triangle_count(), 4, "no instance yet");
        for x in [0.0, 4.0] {
            let transform = Affine3A::from_translation(Vec3::X * x);
            scene.instances.push(Instance {
                prototype,
                transform,
            });
        }
        assert_eq!(scene.triangle_count(), 8, "two instances");
        assert_eq!(scene.emissive_triangle_count(), 6, "both emissive");
        let farthest = Vec3::new(5.0, 1.0, 1.0);
        assert_eq!(scene.bounds(), Aabb::new(Vec3::ZERO, farthest), "box");
    }
}
