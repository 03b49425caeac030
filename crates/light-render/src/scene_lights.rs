use light_scene::Material;
use lights::bounds::LightId;
use lights::sources::{
    Image, Light, LightDesc, LightSet, LightSetBuilder, LightType, Rgb, SceneSphere,
};

use crate::SceneLightsError;
use crate::emitter_ids::EmitterIds;
use crate::listed_lights::ListedLights;
use crate::placed_lights::PlacedLights;
use crate::surface_emission::{AlphaMaskedLights, Textures};
use crate::surface_lights::SurfaceLights;
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
        sphere: SceneSphere,
    ) -> Result<Self, SceneLightsError> {
        let mut builder = LightSetBuilder::new(sphere);
        let mut textures = Textures::new(images);
        let own = (meshes, quadrics);
        let surfaces = SurfaceLights::add(&mut builder, own, materials, &mut textures)?;
        let listed = ListedLights::add(&mut builder, scene_lights, materials.len())?;
        let own_meshes = meshes.len() + listed.mesh_count();
        let placed =
            PlacedLights::add(&mut builder, objects, own_meshes, materials, &mut textures)?;
        let lights = builder.build();

        let in_objects = objects.iter().map(|object| object.meshes.len());
        let all_meshes = own_meshes + in_objects.sum::<usize>();
        let mut emitters = EmitterIds::new(all_meshes, quadrics.len());
        let mut masked = Vec::new();
        surfaces.set_ids(&lights, own, &mut emitters, &mut masked);
        listed.set_ids(&lights, meshes.len(), &mut emitters);
        placed.set_ids(&lights, &mut emitters, &mut masked);
        masked.sort_by_key(|lights| lights.ids.start);
        Ok(Self {
            sources: sources(&surfaces, &listed, &placed),
            infinite: found_outside(&lights),
            listed: listed.hit_ids(&lights),
            listed_meshes: listed.into_meshes(),
            lights,
            emitters,
            masked,
        })
    }
}

/// What each source is, in the order in which they were added to the set.
fn sources(
    surfaces: &SurfaceLights,
    listed: &ListedLights,
    placed: &PlacedLights,
) -> Vec<SceneSource> {
    let meshes = surfaces.meshes.iter().map(|mesh| mesh.index);
    let meshes = meshes.map(SceneSource::Mesh);
    let quadrics = surfaces.quadrics.iter().map(|quadric| quadric.index);
    let quadrics = quadrics.map(SceneSource::Quadric);
    let listed = (0..listed.count).map(SceneSource::Light);
    let placed = placed.meshes.iter().copied().map(SceneSource::Mesh);
    meshes.chain(quadrics).chain(listed).chain(placed).collect()
}

/// The lights that rays find when they leave the scene.
fn found_outside(lights: &LightSet<Rgb>) -> Vec<LightId> {
    let is_found = |id: &LightId| {
        let light = lights.get(*id);
        light.is_some_and(|light| light.light_type() == LightType::Infinite)
    };
    lights.infinite_ids().filter(is_found).collect()
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
