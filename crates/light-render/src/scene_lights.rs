use light_scene::Material;
use lights::bounds::LightId;
use lights::glam::Vec3;
use lights::math::Aabb;
use lights::sources::{
    self as sources, Image, Light, LightDesc, LightSet, LightSetBuilder, LightType, Rgb,
    SceneSphere,
};

use crate::SceneLightsError;
use crate::emitter_ids::EmitterIds;
use crate::placed_lights::PlacedLights;
use crate::surface_emission::{AlphaMaskedLights, Textures};
use crate::world_mesh::WorldMesh;
use crate::world_object::WorldObject;
use crate::world_quadric::WorldQuadric;

/// The lights of a scene.
#[derive(Debug)]
pub(crate) struct SceneLights {
    pub(crate) lights: LightSet<Rgb>,
    /// The ids of emissive meshes and quadrics.
    pub(crate) emitters: EmitterIds,
    /// What each source is, in the order of their ids.
    pub(crate) sources: Vec<SceneSource>,
    /// Those at infinity that rays can find when they leave the scene.
    pub(crate) infinite: Vec<LightId>,
    /// Those with an alpha mask, in the order of their ids.
    pub(crate) masked: Vec<AlphaMaskedLights>,
    /// The area lights and own lights of the scene's list that rays hit, in the order of their
    /// ids.
    pub(crate) listed: Vec<LightId>,
    /// The surfaces of the mesh lights of the scene's list. Their emitters are numbered behind
    /// those of the meshes.
    pub(crate) listed_meshes: Vec<WorldMesh>,
}

/// What a source of lights is in the scene.
#[derive(Clone, Copy, Debug)]
pub(crate) enum SceneSource {
    /// An emissive mesh in world space, or one of an object that an instance places.
    Mesh(usize),
    /// An emissive quadric in world space.
    Quadric(usize),
    /// A light of the scene's list.
    Light(usize),
}

impl SceneLights {
    /// Builds all lights: those of meshes and quadrics in world space, of the scene's list, and
    /// then of objects, instance by instance.
    pub(crate) fn new(
        meshes: &[WorldMesh],
        quadrics: &[WorldQuadric],
        materials: &[Material],
        images: &[Image],
        objects: &[WorldObject],
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
        let mut sources = Vec::new();
        let mut textures = Textures::new(images);
        let mut emissive_meshes = Vec::new();
        for (index, mesh) in meshes.iter().enumerate() {
            let material = &materials[mesh.material];
            if let Some((desc, is_masked)) = textures.mesh_light(mesh, material) {
                let source = add(&mut builder, &material.name, desc)?;
                emissive_meshes.push((index, source, is_masked));
                sources.push(SceneSource::Mesh(index));
            }
        }
        let mut emissive_quadrics = Vec::new();
        for (index, quadric) in quadrics.iter().enumerate() {
            let material = &materials[quadric.material()];
            if let Some((desc, is_masked)) = textures.quadric_light(quadric, material) {
                let source = add(&mut builder, &material.name, desc)?;
                emissive_quadrics.push((index, source, is_masked));
                sources.push(SceneSource::Quadric(index));
            }
        }
        let mut listed = Vec::new();
        let mut listed_meshes = Vec::new();
        for (number, light) in scene_lights.into_iter().enumerate() {
            let mesh = WorldMesh::of_light(&light, materials.len());
            let source = add(&mut builder, &numbered(number), light)?;
            match mesh {
                Some(mesh) => listed_meshes.push((source, mesh)),
                None => listed.push(source),
            }
            sources.push(SceneSource::Light(number));
        }
        let own_meshes = meshes.len() + listed_meshes.len();
        let placed =
            PlacedLights::add(&mut builder, objects, own_meshes, materials, &mut textures)?;
        sources.extend(placed.meshes.iter().copied().map(SceneSource::Mesh));
        let lights = builder.build();
        let in_objects = objects.iter().map(|object| object.meshes.len());
        let all_meshes = own_meshes + in_objects.sum::<usize>();
        let mut emitters = EmitterIds::new(all_meshes, quadrics.len());
        for (index, (source, _)) in (meshes.len()..).zip(&listed_meshes) {
            emitters.set_mesh(index, lights.first_id(*source));
        }
        let mut masked = Vec::new();
        let mut add_masked = |first: Option<LightId>, count, material, is_masked| {
            if let (Some(LightId(first)), true) = (first, is_masked) {
                let ids = first..first + count;
                masked.push(AlphaMaskedLights { ids, material });
            }
        };
        for (index, source, is_masked) in emissive_meshes {
            let mesh = &meshes[index];
            let first = lights.first_id(source);
            emitters.set_mesh(index, first);
            let count = u32::try_from(mesh.indices.len()).unwrap_or(u32::MAX);
            add_masked(first, count, mesh.material, is_masked);
        }
        for (index, source, is_masked) in emissive_quadrics {
            let id = lights.first_id(source);
            emitters.set_quadric(index, id);
            add_masked(id, 1, quadrics[index].material(), is_masked);
        }
        placed.set_ids(&lights, &mut emitters, &mut masked);
        masked.sort_by_key(|lights| lights.ids.start);
        let has_type = |id: &LightId, light_type| {
            lights
                .get(*id)
                .is_some_and(|light| light.light_type() == light_type)
        };
        let infinite = lights.infinite_ids();
        let listed = listed.into_iter();
        let listed = listed.filter_map(|source| lights.first_id(source));
        Ok(Self {
            infinite: infinite
                .filter(|id| has_type(id, LightType::Infinite))
                .collect(),
            listed: listed.filter(|id| has_type(id, LightType::Area)).collect(),
            listed_meshes: listed_meshes.into_iter().map(|(_, mesh)| mesh).collect(),
            lights,
            emitters,
            sources,
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

/// The name of a light of the scene's list that has no name of its own.
pub(crate) fn numbered(light: usize) -> String {
    format!("light {light}")
}

/// The images of a scene, checked for use by lights and surfaces.
pub(crate) fn checked_images(
    images: Vec<light_scene::Image>,
) -> Result<Vec<Image>, SceneLightsError> {
    let checked = |(number, image): (usize, light_scene::Image)| {
        image.to_light().map_err(|error| SceneLightsError::Image {
            name: format!("image {number}"),
            error,
        })
    };
    images.into_iter().enumerate().map(checked).collect()
}
