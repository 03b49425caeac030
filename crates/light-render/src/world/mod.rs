mod holes;
mod materials;

use alloc::sync::Arc;
use core::ops::Range;

use light_scene::{Material, Scene, Surface as Finish};
use lights::bounds::LightId;
use lights::glam::{Vec2, Vec3};
use lights::math::Aabb;
use lights::sources::shape::Triangle;
use lights::sources::{Image, LightSet, MediumId, Rgb, SurfacePoint};

use crate::scene_lights::{SceneLights, SceneLightsError, shown_images};
use crate::world_media::WorldMedia;
use crate::{Accel, Ray, Surface, TriangleId};

/// A scene made ready for rays: triangles in a hierarchy, materials, lights.
#[derive(Debug)]
pub struct World {
    meshes: Vec<WorldMesh>,
    /// Mesh and number in the mesh, a triangle.
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

/// The triangles of one material, with vertices that the lights share.
#[derive(Debug)]
pub(crate) struct WorldMesh {
    pub(crate) positions: Arc<[Vec3]>,
    pub(crate) normals: Option<Vec<Vec3>>,
    pub(crate) uvs: Option<Arc<[Vec2]>>,
    pub(crate) indices: Arc<[[u32; 3]]>,
    pub(crate) material: usize,
    /// The id of the first triangle as a light, if the mesh shines.
    pub(crate) first_light: Option<LightId>,
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
    /// When a light of the scene makes no sense.
    pub fn new(scene: Scene) -> Result<Self, SceneLightsError> {
        let bounds = scene.bounds();
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
        let mut meshes: Vec<WorldMesh> = meshes.into_iter().map(WorldMesh::from).collect();
        let SceneLights { lights, infinite } =
            SceneLights::new(&mut meshes, &materials, &images, lights, &bounds)?;
        let triangles: Vec<MeshTriangle> = (0u32..)
            .zip(&meshes)
            .flat_map(|(mesh, m)| {
                (0u32..)
                    .zip(m.indices.iter())
                    .map(move |(index, _)| MeshTriangle { mesh, index })
            })
            .collect();
        let corners: Vec<[Vec3; 3]> = meshes
            .iter()
            .flat_map(|m| m.indices.iter().map(|&t| m.corners(t)))
            .collect();
        let holed_lights = holes::holed_lights(&meshes, &materials);
        Ok(Self {
            has_holes: materials.iter().any(|material| material.alpha.is_some()),
            holed_lights,
            accel: Accel::new(&corners),
            meshes,
            triangles,
            materials,
            images,
            bounds,
            lights,
            infinite,
            media,
        })
    }

    /// The box around all triangles.
    #[must_use]
    pub const fn bounds(&self) -> &Aabb {
        &self.bounds
    }

    /// All lights.
    #[must_use]
    pub const fn lights(&self) -> &LightSet<Rgb> {
        &self.lights
    }

    /// How many triangles there are.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// The first point of a surface along `ray`, which starts on the triangle `from`.
    #[inline]
    #[must_use]
    pub fn closest(&self, ray: &Ray, from: Option<TriangleId>) -> Option<Surface> {
        let hit = if self.has_holes {
            let is_there = |triangle, place| self.is_there(ray, triangle, place);
            self.accel.closest_where(ray, from, is_there)?
        } else {
            self.accel.closest(ray, from)?
        };
        Some(self.surface(hit.triangle, hit.barycentric))
    }

    /// The point of a triangle at the given barycentric coordinates of its second and third corner.
    ///
    /// # Panics
    /// Panics if there is no such triangle.
    #[inline]
    #[must_use]
    pub fn surface(&self, triangle: TriangleId, barycentric: Vec2) -> Surface {
        let (mesh, indices) = self.mesh(triangle);
        let mut surface = Surface::on_triangle(triangle, mesh.corners(indices), barycentric);
        let weights = [
            1.0 - barycentric.x - barycentric.y,
            barycentric.x,
            barycentric.y,
        ];
        surface.uv = mesh.uv(indices, barycentric);
        if let Some(normals) = &mesh.normals {
            let [a, b, c] = indices.map(|i| normals[i as usize]);
            let ns = a * weights[0] + b * weights[1] + c * weights[2];
            let ns = ns.normalize_or(surface.n);
            surface.ns = if ns.dot(surface.n) < 0.0 { -ns } else { ns };
        }
        surface
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
        let (mesh, _) = self.mesh(surface.triangle);
        self.materials[mesh.material].surface == Finish::Interface
    }

    /// The medium that a ray from `surface` in the direction `wi` starts in, if it `arrived` there through another one.
    #[inline]
    pub(crate) fn medium_toward(
        &self,
        surface: &Surface,
        wi: Vec3,
        arrived: Option<MediumId>,
    ) -> Option<MediumId> {
        let (mesh, _) = self.mesh(surface.triangle);
        let media = self.materials[mesh.material].media;
        if media.inside == media.outside {
            arrived
        } else if wi.dot(surface.n) > 0.0 {
            media.outside
        } else {
            media.inside
        }
    }

    /// Whether anything but the triangle `from` lies within `distance` along `ray`.
    #[inline]
    pub(crate) fn blocked(&self, ray: &Ray, distance: f32, from: Option<TriangleId>) -> bool {
        if self.has_holes {
            let is_there = |triangle, place| self.is_there(ray, triangle, place);
            self.accel.occluded_where(ray, distance, from, is_there)
        } else {
            self.accel.occluded(ray, distance, from)
        }
    }

    /// Whether nothing lies between two points; a surface that the second lies on does not count.
    #[inline]
    pub(crate) fn sees(&self, from: Vec3, to: Vec3) -> bool {
        let way = to - from;
        let distance = way.length();
        let ray = Ray {
            origin: from,
            direction: way / distance,
        };
        !(distance > 0.0 && self.blocked(&ray, distance * (1.0 - 1e-4), None))
    }

    /// Whether anything lies between `surface` and the point `p_light` that is seen from it in direction `wi`.
    #[inline]
    #[must_use]
    pub fn occluded(&self, surface: &Surface, wi: Vec3, p_light: Vec3) -> bool {
        /// How much of the way is looked at: the light itself must not be in the way.
        const PART: f32 = 1.0 - 1e-4;
        let origin = surface.spawn(wi).origin;
        let way = p_light - origin;
        let distance = way.length();
        let ray = Ray {
            origin,
            direction: way / distance,
        };
        distance > 0.0 && self.blocked(&ray, distance * PART, Some(surface.triangle))
    }

    /// The light that `surface` is part of and the radiance that it sends toward `wo`; `None` where it sends none.
    #[inline]
    #[must_use]
    pub fn emitted(&self, surface: &Surface, wo: Vec3) -> Option<(LightId, Vec3)> {
        let MeshTriangle { mesh, index } = self.triangles[surface.triangle.0 as usize];
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
    fn mesh(&self, triangle: TriangleId) -> (&WorldMesh, [u32; 3]) {
        let MeshTriangle { mesh, index } = self.triangles[triangle.0 as usize];
        let mesh = &self.meshes[mesh as usize];
        (mesh, mesh.indices[index as usize])
    }
}

impl WorldMesh {
    /// The texture coordinates on a triangle: those that its light has too.
    #[inline]
    fn uv(&self, triangle: [u32; 3], barycentric: Vec2) -> Vec2 {
        let [a, b, c] = match &self.uvs {
            Some(uvs) => triangle.map(|i| uvs[i as usize]),
            None => Triangle::DEFAULT_UV,
        };
        let Vec2 { x, y } = barycentric;
        a * (1.0 - x - y) + b * x + c * y
    }

    fn corners(&self, triangle: [u32; 3]) -> [Vec3; 3] {
        triangle.map(|i| self.positions[i as usize])
    }
}

impl From<light_scene::Mesh> for WorldMesh {
    fn from(mesh: light_scene::Mesh) -> Self {
        Self {
            positions: mesh.positions.into(),
            normals: mesh.normals,
            uvs: mesh.uvs.map(Arc::from),
            indices: mesh.indices.into(),
            material: mesh.material.0 as usize,
            first_light: None,
        }
    }
}
