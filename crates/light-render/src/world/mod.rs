mod error;
mod holes;
mod materials;
mod mesh;
mod mixtures;
mod objects;
mod rays;

use core::ops::Range;

use light_scene::{Material, Scene, Surface as Finish};
use lights::bounds::LightId;
use lights::glam::{Vec2, Vec3};
use lights::math::Aabb;
use lights::sources::{Image, LightSet, MediumId, Rgb, SurfacePoint};

use crate::scene_lights::{SceneLights, shown_images};
use crate::world_media::WorldMedia;
use crate::{Accel, PrimitiveId, Prototype, Ray, Surface};
pub use error::WorldError;
pub(crate) use mesh::WorldMesh;
use objects::{Objects, PlacedObject};

/// A scene made ready for rays: triangles in hierarchies, materials, lights.
///
/// What stands in several places is stored once, but for triangles that shine: each is a light of its own, with an id and vertices in
/// the scene. Objects of very few triangles are copied as well, because a placement takes as much memory as they do.
#[derive(Debug)]
pub struct World {
    /// Those that stand where they are stored, then those of prototypes.
    meshes: Vec<WorldMesh>,
    /// Mesh and number in the mesh, a stored triangle.
    triangles: Vec<MeshTriangle>,
    accel: Accel,
    materials: Vec<Material>,
    images: Vec<Image>,
    bounds: Aabb,
    lights: LightSet<Rgb>,
    infinite: Vec<LightId>,
    media: WorldMedia,
    /// Whether any surface has holes.
    has_holes: bool,
    /// The ids of the lights that have.
    holed_lights: Vec<Range<u32>>,
}

#[derive(Clone, Copy, Debug)]
struct MeshTriangle {
    mesh: u32,
    index: u32,
}

impl World {
    /// The world that `scene` describes.
    ///
    /// # Errors
    /// When a light of the scene makes no sense, an object stands where it would be flat, or shining objects stand in too many places.
    pub fn new(mut scene: Scene) -> Result<Self, WorldError> {
        let bounds = scene.bounds();
        let Objects { copies, placed } = Objects::take(&mut scene)?;
        let Scene {
            meshes,
            materials,
            images,
            lights,
            media,
            camera_medium,
            ..
        } = scene;
        let images = shown_images(images)?;
        let media = WorldMedia::new(media, camera_medium, &materials);
        let mut meshes: Vec<WorldMesh> = meshes
            .into_iter()
            .chain(copies)
            .map(WorldMesh::from)
            .collect();
        let SceneLights { lights, infinite } =
            SceneLights::new(&mut meshes, &materials, &images, lights, &bounds)?;
        let holed_lights = holes::holed_lights(&meshes, &materials);
        let corners: Vec<[Vec3; 3]> = meshes.iter().flat_map(WorldMesh::triangles).collect();
        let prototypes = placed.into_iter().map(
            |PlacedObject {
                 meshes: own,
                 places,
             }| {
                let first = meshes.len();
                meshes.extend(own.into_iter().map(WorldMesh::from));
                let triangles = meshes[first..]
                    .iter()
                    .flat_map(WorldMesh::triangles)
                    .collect();
                Prototype { triangles, places }
            },
        );
        let accel = Accel::with_prototypes(&corners, prototypes);
        let triangles = (0u32..).zip(&meshes).flat_map(|(mesh, m)| {
            let indices = (0u32..).zip(m.indices.iter());
            indices.map(move |(index, _)| MeshTriangle { mesh, index })
        });
        Ok(Self {
            has_holes: materials.iter().any(|material| material.alpha.is_some()),
            holed_lights,
            triangles: triangles.collect(),
            accel,
            meshes,
            materials,
            images,
            bounds,
            lights,
            infinite,
            media,
        })
    }

    /// A box around all triangles.
    #[must_use]
    pub const fn bounds(&self) -> &Aabb {
        &self.bounds
    }

    /// All lights.
    #[must_use]
    pub const fn lights(&self) -> &LightSet<Rgb> {
        &self.lights
    }

    /// How many triangles there are to be seen: those of prototypes in each of their places.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        let placed: usize = self.accel.placements().map(|numbers| numbers.len()).sum();
        self.accel.world_triangle_count() as usize + placed
    }

    /// How many triangles are stored.
    #[must_use]
    pub fn stored_triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// How many objects are stored once and stand in several places.
    #[must_use]
    pub fn prototype_count(&self) -> usize {
        self.accel.prototype_count()
    }

    /// In how many places they stand, all together.
    #[must_use]
    pub fn placement_count(&self) -> usize {
        self.accel.placements().len()
    }

    /// The `n`th of the triangles that [`triangle_count`](Self::triangle_count) counts.
    #[must_use]
    pub fn triangle(&self, n: usize) -> Option<PrimitiveId> {
        let world = self.accel.world_triangle_count();
        let number = u32::try_from(n).ok().filter(|&number| number < world);
        number.map(PrimitiveId::new).or_else(|| {
            let mut before = world as usize;
            (0u32..)
                .zip(self.accel.placements())
                .find_map(|(placement, mut numbers)| {
                    let here = n.checked_sub(before);
                    before += numbers.len();
                    Some(PrimitiveId::placed(numbers.nth(here?)?, placement))
                })
        })
    }

    /// The point of a triangle at the given barycentric coordinates of its second and third corner.
    ///
    /// # Panics
    /// Panics if there is no such triangle.
    #[inline]
    #[must_use]
    pub fn surface(&self, triangle: PrimitiveId, barycentric: Vec2) -> Surface {
        let (mesh, indices, weights) = self.spot(triangle, barycentric);
        let (mut corners, mut normals) = (mesh.corners(indices), mesh.normals(indices));
        let place = triangle.placement().map(|p| self.accel.place(p));
        if let Some(place) = place {
            // As a copy would look: corners and normals are moved before they are mixed.
            corners = corners.map(|corner| place.point(corner));
            normals = normals.map(|all| all.map(|n| place.normal(n).normalize_or_zero()));
        }
        let surface = Surface::on_triangle(triangle, corners, weights);
        let error = place.map_or(Vec3::ZERO, |place| place.error(surface.p));
        Surface {
            uv: mesh.uv(indices, weights),
            p_error: surface.p_error + error,
            ..surface.with_normals(normals, weights)
        }
    }

    /// Whether there are media between the surfaces.
    #[must_use]
    pub fn has_media(&self) -> bool {
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

    /// The medium that a ray from `surface` in the direction `wi` starts in, if it `arrived` there through another one.
    #[inline]
    pub(crate) fn medium_toward(
        &self,
        surface: &Surface,
        wi: Vec3,
        arrived: Option<MediumId>,
    ) -> Option<MediumId> {
        let (mesh, _) = self.mesh(surface.primitive);
        let media = self.materials[mesh.material].media;
        if media.inside == media.outside {
            arrived
        } else if wi.dot(surface.n) > 0.0 {
            media.outside
        } else {
            media.inside
        }
    }

    /// The light that `surface` is part of and the radiance that it sends toward `wo`; `None` where it sends none.
    #[inline]
    #[must_use]
    pub fn emitted(&self, surface: &Surface, wo: Vec3) -> Option<(LightId, Vec3)> {
        let MeshTriangle { mesh, index } = self.triangles[surface.primitive.number() as usize];
        let LightId(first) = self.meshes[mesh as usize].first_light?;
        let id = LightId(first + index);
        let at = SurfacePoint {
            p: surface.p,
            n: surface.n,
            uv: surface.uv,
        };
        let l = self.lights.get(id)?.l(&at, wo, &());
        (l != Vec3::ZERO).then_some((id, l))
    }

    /// The lights that rays find by leaving the scene.
    #[must_use]
    pub fn infinite_lights(&self) -> &[LightId] {
        &self.infinite
    }

    /// The radiance of an infinite light along a ray that leaves the scene.
    #[inline]
    #[must_use]
    pub fn sky_radiance(&self, light: LightId, ray: &Ray) -> Vec3 {
        self.lights
            .get(light)
            .map_or(Vec3::ZERO, |light| light.le(ray.origin, ray.direction, &()))
    }

    #[inline]
    fn mesh(&self, triangle: PrimitiveId) -> (&WorldMesh, [u32; 3]) {
        let MeshTriangle { mesh, index } = self.triangles[triangle.number() as usize];
        let mesh = &self.meshes[mesh as usize];
        (mesh, mesh.indices[index as usize])
    }

    /// The mesh of a triangle, its corners in the order in which they run counter-clockwise on its front, and the weights of the
    /// second and the third: where a placement mirrors, these change places.
    #[inline]
    fn spot(&self, triangle: PrimitiveId, barycentric: Vec2) -> (&WorldMesh, [u32; 3], Vec2) {
        let (mesh, [a, b, c]) = self.mesh(triangle);
        match triangle.placement() {
            Some(placement) if self.accel.place(placement).mirrors() => {
                (mesh, [a, c, b], Vec2::new(barycentric.y, barycentric.x))
            }
            _ => (mesh, [a, b, c], barycentric),
        }
    }
}
