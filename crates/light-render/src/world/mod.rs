mod alpha_mask;
mod count;
mod digests;
mod error;
mod light_names;
mod listed_lights;
mod materials;
mod mixtures;
mod normal_map;
mod objects;
mod primitives;
mod rays;

use light_scene::{BackFaces, Material, Scene, Surface as Finish};
use lights::bounds::LightId;
use lights::glam::Vec3;
use lights::math::Aabb;
use lights::sources::{Image, LightSet, MediumId, Rgb};

use crate::emitter_ids::EmitterIds;
use crate::scene_bounds::scene_sphere;
use crate::scene_lights::{SceneLights, SceneSource, checked_images};
use crate::surface_emission::AlphaMaskedLights;
use crate::world_media::WorldMedia;
use crate::world_mesh::WorldMesh;
use crate::world_quadric::WorldQuadric;
use crate::{Accel, Prototype, QuadricShape, Ray, Surface};
pub use error::WorldError;
use objects::Objects;

/// A scene prepared for rendering: acceleration structures, materials, lights, media.
///
/// Prototypes are stored once, emissive meshes among them: each triangle of each instance is a
/// light of its own, with an id. Objects of very few triangles are copied, because an instance
/// takes as much memory as they do, and so are emissive quadrics.
#[derive(Debug)]
pub struct World {
    /// Those in world space, then those of prototypes.
    meshes: Vec<WorldMesh>,
    /// For each stored triangle its mesh and its index there.
    triangles: Vec<MeshTriangle>,
    /// Those in world space, then those of prototypes.
    quadrics: Vec<WorldQuadric>,
    accel: Accel,
    /// Those of the scene, and behind them that of listed lights, if rays hit any.
    materials: Vec<Material>,
    images: Vec<Image>,
    bounds: Aabb,
    lights: LightSet<Rgb>,
    emitters: EmitterIds,
    sources: Vec<SceneSource>,
    /// Names of the lights of the scene's list.
    light_names: Vec<String>,
    infinite: Vec<LightId>,
    /// The area lights and own lights of the scene's list that rays hit. Their surfaces have the
    /// numbers behind those of quadrics.
    listed_lights: Vec<LightId>,
    media: WorldMedia,
    /// Whether rays pass through anything: alpha masks, back faces that are culled, what parts of
    /// quadrics lack.
    has_any_hits: bool,
    /// Whether any material has a normal map.
    has_normal_maps: bool,
    /// The lights with an alpha mask, in the order of their ids.
    masked_lights: Vec<AlphaMaskedLights>,
}

#[derive(Clone, Copy, Debug)]
struct MeshTriangle {
    mesh: u32,
    index: u32,
}

impl World {
    /// The world that `scene` describes.
    ///
    /// Lights of the scene's list that have a surface (area lights, mesh lights and
    /// [`OwnLight::Area`](lights::sources::OwnLight)) are seen and cast shadows as black bodies
    /// that emit. Meshes are in the acceleration structure; every ray is tested against each of the
    /// others. A mask of such a light darkens its emission and opens no holes. Invisible ones only
    /// send light.
    ///
    /// # Errors
    /// When a light is invalid, a transform makes a sphere an ellipsoid or an object flat, or there
    /// are too many lights in all instances.
    pub fn new(mut scene: Scene) -> Result<Self, WorldError> {
        // First: the box takes time for each copy.
        Objects::refuse_copies(&scene)?;
        let bounds = scene.bounds();
        let sphere = scene_sphere(&scene, &bounds)?;
        let objects = Objects::take(&mut scene)?.instanced;
        let Scene {
            meshes,
            quadrics,
            mut materials,
            images,
            lights,
            light_names,
            media,
            camera_medium,
            ..
        } = scene;
        let images = checked_images(images)?;
        let media = WorldMedia::new(media, camera_medium, &materials);
        let mut meshes: Vec<WorldMesh> = meshes.into_iter().map(WorldMesh::from).collect();
        let mut quadrics = world_quadrics(quadrics)?;
        let SceneLights {
            lights,
            infinite,
            emitters,
            sources,
            masked: masked_lights,
            listed: listed_lights,
            listed_meshes,
        } = SceneLights::new(
            &meshes, &quadrics, &materials, &images, &objects, lights, sphere,
        )?;
        if !(listed_lights.is_empty() && listed_meshes.is_empty()) {
            materials.push(Material::diffuse("listed light", Vec3::ZERO));
        }
        meshes.extend(listed_meshes);
        let corners: Vec<[Vec3; 3]> = meshes.iter().flat_map(WorldMesh::triangles).collect();
        let own_quadrics = shapes(&quadrics);
        let mut prototypes = Vec::with_capacity(objects.len());
        for object in objects {
            let triangles = object.meshes.iter().flat_map(WorldMesh::triangles);
            prototypes.push(Prototype {
                triangles: triangles.collect(),
                quadrics: shapes(&object.quadrics),
                transforms: object.transforms,
            });
            meshes.extend(object.meshes);
            quadrics.extend(object.quadrics);
        }
        let accel = Accel::with_quadrics_and_prototypes(&corners, &own_quadrics, prototypes);
        let triangles = (0u32..).zip(&meshes).flat_map(|(mesh, m)| {
            let indices = (0u32..).zip(m.indices.iter());
            indices.map(move |(index, _)| MeshTriangle { mesh, index })
        });
        Ok(Self {
            has_any_hits: materials.iter().any(|material| {
                material.alpha.is_some() || material.back_faces == BackFaces::Culled
            }) || quadrics.iter().any(|q| q.described.part.is_some()),
            has_normal_maps: materials
                .iter()
                .any(|material| material.normal_map.is_some()),
            masked_lights,
            triangles: triangles.collect(),
            accel,
            meshes,
            quadrics,
            materials,
            images,
            bounds,
            lights,
            emitters,
            sources,
            light_names,
            infinite,
            listed_lights,
            media,
        })
    }

    /// A box around all geometry.
    #[must_use]
    pub const fn bounds(&self) -> &Aabb {
        &self.bounds
    }

    /// All lights.
    #[must_use]
    pub const fn lights(&self) -> &LightSet<Rgb> {
        &self.lights
    }

    /// Whether there are media between the surfaces.
    #[must_use]
    pub(crate) fn has_media(&self) -> bool {
        !self.media.is_empty()
    }

    pub(crate) const fn media(&self) -> &WorldMedia {
        &self.media
    }

    /// Whether light passes unchanged through the material at `surface`.
    #[inline]
    pub(crate) fn is_interface(&self, surface: &Surface) -> bool {
        matches!(self.finish(surface), Finish::Interface)
    }

    /// The medium that a ray from `surface` in the direction `wi` starts in, if it `arrived` there
    /// through another one.
    #[inline]
    pub(crate) fn medium_toward(
        &self,
        surface: &Surface,
        wi: Vec3,
        arrived: Option<MediumId>,
    ) -> Option<MediumId> {
        let (_, material) = self.material(surface.primitive);
        let media = material.media;
        if media.inside == media.outside {
            arrived
        } else if wi.dot(surface.n) > 0.0 {
            media.outside
        } else {
            media.inside
        }
    }

    /// The lights that rays find by leaving the scene.
    #[must_use]
    pub fn infinite_lights(&self) -> &[LightId] {
        &self.infinite
    }

    /// The radiance of an infinite light along a ray that leaves the scene.
    #[inline]
    #[must_use]
    pub(crate) fn sky_radiance(&self, light: LightId, ray: &Ray) -> Vec3 {
        self.lights
            .get(light)
            .map_or(Vec3::ZERO, |light| light.le(ray.origin, ray.direction, &()))
    }
}

fn world_quadrics(quadrics: Vec<light_scene::Quadric>) -> Result<Vec<WorldQuadric>, WorldError> {
    quadrics.into_iter().map(WorldQuadric::try_from).collect()
}

fn shapes(quadrics: &[WorldQuadric]) -> Vec<QuadricShape> {
    quadrics.iter().map(|quadric| quadric.shape).collect()
}
