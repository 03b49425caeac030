use core::error::Error;
use core::fmt;

use light_scene::Material;
use lights::bounds::LightId;
use lights::glam::Vec3;
use lights::math::Aabb;
use lights::sources::{
    self as sources, Image, Light, LightDesc, LightDescError, LightSet, LightSetBuilder, LightType,
    Rgb, SceneSphere, SceneSphereError,
};

use crate::surface_emission::{AlphaMaskedLights, Textures};
use crate::world_mesh::WorldMesh;
use crate::world_sphere::WorldSphere;

/// The lights of a scene.
#[derive(Debug)]
pub(crate) struct SceneLights {
    pub(crate) lights: LightSet<Rgb>,
    /// Those that rays find by leaving the scene.
    pub(crate) infinite: Vec<LightId>,
    /// Those with an alpha mask, in the order of their ids.
    pub(crate) masked: Vec<AlphaMaskedLights>,
}

/// Why the lights of a scene cannot be built.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SceneLightsError {
    /// The scene's box is not finite.
    Bounds(SceneSphereError),
    /// A light makes no sense; the name is that of its material, or its kind and number.
    Light {
        /// Which light.
        name: String,
        /// What is wrong with it.
        error: LightDescError,
    },
    /// An image has texels that are no light.
    Image {
        /// Which image.
        name: String,
        /// What is wrong with it.
        error: sources::ImageError,
    },
}

impl SceneLights {
    /// Builds all lights, and sets the ids of the lights of meshes and spheres.
    pub(crate) fn new(
        meshes: &mut [WorldMesh],
        spheres: &mut [WorldSphere],
        materials: &[Material],
        images: &[Image],
        scene_lights: Vec<LightDesc<Rgb>>,
        bounds: &Aabb,
    ) -> Result<Self, SceneLightsError> {
        let sphere = if bounds.is_empty() {
            SceneSphere::new(Vec3::ZERO, 1.0)
        } else {
            // A scene of a single point still has an outside.
            let (center, radius) = bounds.bounding_sphere();
            SceneSphere::new(center, radius.max(f32::MIN_POSITIVE))
        };
        let mut builder = LightSetBuilder::new(sphere.map_err(SceneLightsError::Bounds)?);
        let mut textures = Textures::new(images);
        let mut emissive_meshes = Vec::new();
        for (index, mesh) in meshes.iter().enumerate() {
            let material = &materials[mesh.material];
            if let Some((desc, is_masked)) = textures.mesh_light(mesh, material) {
                let source = add(&mut builder, &material.name, desc)?;
                emissive_meshes.push((index, source, is_masked));
            }
        }
        let mut emissive_spheres = Vec::new();
        for (index, sphere) in spheres.iter().enumerate() {
            let material = &materials[sphere.material];
            if let Some((desc, is_masked)) = textures.sphere_light(sphere, material) {
                let source = add(&mut builder, &material.name, desc)?;
                emissive_spheres.push((index, source, is_masked));
            }
        }
        for (number, light) in scene_lights.into_iter().enumerate() {
            let name = format!("light {number}");
            add(&mut builder, &name, light)?;
        }
        let lights = builder.build();
        let mut masked = Vec::new();
        let mut note = |first: Option<LightId>, count, material, is_masked| {
            if let (Some(LightId(first)), true) = (first, is_masked) {
                let ids = first..first + count;
                masked.push(AlphaMaskedLights { ids, material });
            }
        };
        for (index, source, is_masked) in emissive_meshes {
            let mesh = &mut meshes[index];
            mesh.first_light = lights.first_id(source);
            let count = u32::try_from(mesh.indices.len()).unwrap_or(u32::MAX);
            note(mesh.first_light, count, mesh.material, is_masked);
        }
        for (index, source, is_masked) in emissive_spheres {
            let sphere = &mut spheres[index];
            sphere.light = lights.first_id(source);
            note(sphere.light, 1, sphere.material, is_masked);
        }
        masked.sort_by_key(|lights| lights.ids.start);
        let found_by_rays = |id: &LightId| {
            lights
                .get(*id)
                .is_some_and(|light| light.light_type() == LightType::Infinite)
        };
        Ok(Self {
            infinite: lights.infinite_ids().filter(found_by_rays).collect(),
            lights,
            masked,
        })
    }
}

fn add(
    builder: &mut LightSetBuilder<Rgb>,
    name: &str,
    desc: LightDesc<Rgb>,
) -> Result<sources::SourceId, SceneLightsError> {
    builder.add(desc).map_err(|error| SceneLightsError::Light {
        name: name.into(),
        error,
    })
}

/// The images of a scene, as lights and surfaces hold them.
pub(crate) fn shown_images(
    images: Vec<light_scene::Image>,
) -> Result<Vec<Image>, SceneLightsError> {
    let shown = |(number, image): (usize, light_scene::Image)| {
        image.to_light().map_err(|error| SceneLightsError::Image {
            name: format!("image {number}"),
            error,
        })
    };
    images.into_iter().enumerate().map(shown).collect()
}

impl fmt::Display for SceneLightsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bounds(error) => error.fmt(f),
            Self::Light { name, error } => write!(f, "{name}: {error}"),
            Self::Image { name, error } => write!(f, "{name}: {error}"),
        }
    }
}

impl Error for SceneLightsError {}
