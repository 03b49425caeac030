use light_scene::{Material, UvSet};
use lights::bounds::LightId;
use lights::glam::{Vec2, Vec3};
use lights::sources::SurfacePoint;

use super::{MeshTriangle, World};
use crate::world_mesh::WorldMesh;
use crate::world_quadric::WorldQuadric;
use crate::{InstanceTransform, PrimitiveId, QuadricShape, Ray, Surface};

/// The triangle, quadric or listed light with a primitive's number.
#[derive(Clone, Copy, Debug)]
enum Stored<'a> {
    /// A triangle of a mesh.
    Triangle { mesh: &'a WorldMesh, index: u32 },
    /// A sphere, disk or cylinder.
    Quadric(&'a WorldQuadric),
    /// The surface of a light of the scene's list.
    Listed,
}

impl World {
    /// The point of a primitive at the coordinates of [`Hit::coords`](crate::Hit::coords).
    ///
    /// # Panics
    /// Panics if there is no such primitive, or for the surface of an area light or an own light
    /// of the scene's list, which has no coordinates.
    #[inline]
    #[must_use]
    pub fn surface(&self, primitive: PrimitiveId, coords: Vec2) -> Surface {
        match self.stored(primitive) {
            Stored::Triangle { mesh, index } => self.on_triangle(primitive, mesh, index, coords),
            Stored::Quadric(quadric) => self.on_quadric(primitive, quadric, coords),
            Stored::Listed => panic!("listed lights have no coordinates"),
        }
    }

    fn on_triangle(
        &self,
        triangle: PrimitiveId,
        mesh: &WorldMesh,
        index: u32,
        barycentric: Vec2,
    ) -> Surface {
        let (indices, weights) = self.oriented(triangle, mesh.vertices(index), barycentric);
        let (mut corners, mut normals) = (mesh.corners(indices), mesh.normals(indices));
        let transform = self.transform(triangle);
        if let Some(transform) = transform {
            // Transformed before they are interpolated, as those of a copied mesh are.
            corners = corners.map(|corner| transform.point(corner));
            normals = normals.map(|all| all.map(|n| transform.normal(n).normalize_or_zero()));
        }
        let surface = Surface::on_triangle(triangle, corners, weights);
        let error = transform.map_or(Vec3::ZERO, |transform| transform.error(surface.p));
        Surface {
            uv: mesh.uv(indices, weights),
            second_uv: mesh.second_uv(indices, weights),
            color: mesh.color(indices, weights),
            p_error: surface.p_error + error,
            ..surface.with_normals(normals, weights)
        }
    }

    // Not inlined: most scenes have no quadrics.
    #[inline(never)]
    fn on_quadric(&self, id: PrimitiveId, quadric: &WorldQuadric, coords: Vec2) -> Surface {
        let at = quadric.at(coords);
        let n = quadric.front_normal(at.n);
        let surface = Surface::on_quadric(id, &quadric.shape, &SurfacePoint { n, ..at });
        match self.transform(id) {
            Some(transform) => transform.surface(&surface),
            None => surface,
        }
    }

    /// The material of the primitive.
    #[inline]
    pub(super) fn material(&self, primitive: PrimitiveId) -> (usize, &Material) {
        let id = match self.stored(primitive) {
            Stored::Triangle { mesh, .. } => mesh.material,
            Stored::Quadric(quadric) => quadric.material(),
            Stored::Listed => self.materials.len() - 1,
        };
        (id, &self.materials[id])
    }

    /// The first and the second texture coordinates of a point on a primitive.
    pub(super) fn uvs(&self, primitive: PrimitiveId, coords: Vec2) -> [Vec2; 2] {
        match self.stored(primitive) {
            Stored::Triangle { mesh, index } => {
                let (indices, weights) = self.oriented(primitive, mesh.vertices(index), coords);
                [mesh.uv(indices, weights), mesh.second_uv(indices, weights)]
            }
            Stored::Quadric(quadric) => [quadric.at(coords).uv, Vec2::ZERO],
            Stored::Listed => [coords, Vec2::ZERO],
        }
    }

    /// Whether the primitive has a point with these coordinates: a part of a quadric lacks those of
    /// the rest of it.
    pub(crate) fn is_there(&self, primitive: PrimitiveId, coords: Vec2) -> bool {
        match self.stored(primitive) {
            Stored::Quadric(quadric) => quadric.is_there(coords),
            _ => true,
        }
    }

    /// Whether `ray` arrives at the back of a triangle.
    pub(super) fn is_seen_from_behind(&self, ray: &Ray, primitive: PrimitiveId) -> bool {
        let Stored::Triangle { mesh, index } = self.stored(primitive) else {
            return false;
        };
        let (indices, _) = self.oriented(primitive, mesh.vertices(index), Vec2::ZERO);
        let mut corners = mesh.corners(indices);
        if let Some(transform) = self.transform(primitive) {
            corners = corners.map(|corner| transform.point(corner));
        }
        let [a, b, c] = corners;
        (b - a).cross(c - a).dot(ray.direction) > 0.0
    }

    /// The directions of u and v on a triangle, of unit length and at right angles to the shading
    /// normal of `surface`; `None` where it has none.
    ///
    /// # Source
    /// `[GLTF]`, section 3.7.2.1.
    pub(super) fn tangents(
        &self,
        surface: &Surface,
        coords: Vec2,
        set: UvSet,
    ) -> Option<[Vec3; 2]> {
        let primitive = surface.primitive;
        let Stored::Triangle { mesh, index } = self.stored(primitive) else {
            return None;
        };
        let (indices, weights) = self.oriented(primitive, mesh.vertices(index), coords);
        let transform = self.transform(primitive);
        let n = surface.ns;
        if let Some(tangent) = mesh.tangent(indices, weights) {
            let (direction, mut side) = (tangent.truncate(), tangent.w);
            let direction = match transform {
                Some(transform) => transform.vector(direction),
                None => direction,
            };
            if transform.is_some_and(InstanceTransform::mirrors) {
                side = -side;
            }
            let t = direction.reject_from_normalized(n).try_normalize()?;
            let side = if side < 0.0 { -1.0 } else { 1.0 };
            return Some([t, n.cross(t) * side]);
        }
        let mut corners = mesh.corners(indices);
        if let Some(transform) = transform {
            corners = corners.map(|corner| transform.point(corner));
        }
        let [a, b, c] = corners;
        let [uv_a, uv_b, uv_c] = mesh.corner_uvs(indices, set);
        let ([e1, e2], [d1, d2]) = ([b - a, c - a], [uv_b - uv_a, uv_c - uv_a]);
        // The gradients of the coordinates, but for the size of their determinant.
        let side = if d1.perp_dot(d2) < 0.0 { -1.0 } else { 1.0 };
        let [u, v] = [e1 * d2.y - e2 * d1.y, e2 * d1.x - e1 * d2.x].map(|way| way * side);
        let t = u.reject_from_normalized(n).try_normalize()?;
        let bitangent = n.cross(t);
        let side = if bitangent.dot(v) < 0.0 { -1.0 } else { 1.0 };
        Some([t, bitangent * side])
    }

    /// The shape of the primitive in object space, if it is a quadric.
    pub(crate) fn quadric(&self, primitive: PrimitiveId) -> Option<&QuadricShape> {
        match self.stored(primitive) {
            Stored::Quadric(quadric) => Some(&quadric.shape),
            _ => None,
        }
    }

    /// The light that `surface` is part of and the radiance that it sends toward `wo`; `None` where
    /// it sends none.
    #[inline]
    #[must_use]
    pub(crate) fn emitted(&self, surface: &Surface, wo: Vec3) -> Option<(LightId, Vec3)> {
        let number = surface.primitive.number() as usize;
        let (id, n) = match self.triangles.get(number) {
            Some(&MeshTriangle { mesh, index }) => {
                let id = match surface.primitive.instance() {
                    None => self.emitters.triangle(mesh, index),
                    Some(instance) => {
                        let position = self.accel.instance_position(instance);
                        self.emitters.triangle_in(position, mesh, index)
                    }
                };
                (id?, surface.n)
            }
            None => {
                let number = number - self.triangles.len();
                match self.quadrics.get(number) {
                    // The light of a quadric has its front outside, whatever the front of the
                    // surface.
                    Some(quadric) => {
                        let id = self.emitters.quadric(number)?;
                        (id, quadric.front_normal(surface.n))
                    }
                    None => (self.listed_light(number - self.quadrics.len())?, surface.n),
                }
            }
        };
        let at = SurfacePoint {
            p: surface.p,
            n,
            uv: surface.uv,
        };
        let l = self.lights.get(id)?.l(&at, wo, &());
        (l != Vec3::ZERO).then(|| (id, self.radiance_at_hit(id, surface, l)))
    }

    /// The transform of the instance that the primitive belongs to; `None` in world space.
    #[inline]
    fn transform(&self, primitive: PrimitiveId) -> Option<&InstanceTransform> {
        let instance = primitive.instance()?;
        Some(self.accel.instance_transform(instance))
    }

    #[inline]
    fn stored(&self, primitive: PrimitiveId) -> Stored<'_> {
        let number = primitive.number() as usize;
        match self.triangles.get(number) {
            Some(&MeshTriangle { mesh, index }) => Stored::Triangle {
                mesh: &self.meshes[mesh as usize],
                index,
            },
            None => match self.quadrics.get(number - self.triangles.len()) {
                Some(quadric) => Stored::Quadric(quadric),
                None => Stored::Listed,
            },
        }
    }

    /// The corners of a triangle, counter-clockwise on its front, and the weights of the second and
    /// the third. A mirroring transform swaps these two.
    #[inline]
    fn oriented(
        &self,
        triangle: PrimitiveId,
        [a, b, c]: [u32; 3],
        barycentric: Vec2,
    ) -> ([u32; 3], Vec2) {
        match self.transform(triangle) {
            Some(transform) if transform.mirrors() => {
                ([a, c, b], Vec2::new(barycentric.y, barycentric.x))
            }
            _ => ([a, b, c], barycentric),
        }
    }
}
