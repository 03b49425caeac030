use alloc::sync::Arc;
use core::ops::{Add, Mul};

use light_scene::{Mesh, UvSet};
use lights::glam::{Vec2, Vec3, Vec4};
use lights::sources::shape::Triangle;
use lights::sources::{EmissionMask, LightDesc, MeshIndices, Rgb};

/// The triangles of one material, with vertices that the lights share.
#[derive(Debug, serde::Serialize)]
pub(crate) struct WorldMesh {
    pub(crate) name: String,
    pub(crate) positions: Arc<[Vec3]>,
    pub(crate) normals: Option<Vec<Vec3>>,
    pub(crate) uvs: Option<Arc<[Vec2]>>,
    pub(crate) shading: ShadingAttributes,
    pub(crate) indices: MeshIndices,
    pub(crate) material: usize,
}

/// What few meshes have at their vertices, and no light knows.
#[derive(Debug, Default, serde::Serialize)]
pub(crate) struct ShadingAttributes {
    pub(crate) second_uvs: Option<Vec<Vec2>>,
    pub(crate) tangents: Option<Vec<Vec4>>,
    pub(crate) colors: Option<Vec<Vec3>>,
}

impl WorldMesh {
    /// The texture coordinates on a triangle: those that its light has too.
    #[inline]
    pub(super) fn uv(&self, triangle: [u32; 3], barycentric: Vec2) -> Vec2 {
        interpolate(self.corner_uvs(triangle, UvSet::First), barycentric)
    }

    /// The second texture coordinates on a triangle.
    #[inline]
    pub(super) fn second_uv(&self, triangle: [u32; 3], barycentric: Vec2) -> Vec2 {
        match &self.shading.second_uvs {
            Some(_) => interpolate(self.corner_uvs(triangle, UvSet::Second), barycentric),
            None => Vec2::ZERO,
        }
    }

    /// The texture coordinates of the corners.
    #[inline]
    pub(super) fn corner_uvs(&self, triangle: [u32; 3], set: UvSet) -> [Vec2; 3] {
        let uvs = match set {
            UvSet::First => self.uvs.as_deref(),
            UvSet::Second => self.shading.second_uvs.as_deref(),
        };
        match uvs {
            Some(uvs) => triangle.map(|i| uvs[i as usize]),
            None => Triangle::DEFAULT_UV,
        }
    }

    /// The colour of the vertices on a triangle; white without them.
    #[inline]
    pub(super) fn color(&self, triangle: [u32; 3], barycentric: Vec2) -> Vec3 {
        match &self.shading.colors {
            Some(colors) => interpolate(triangle.map(|i| colors[i as usize]), barycentric),
            None => Vec3::ONE,
        }
    }

    /// The tangent on a triangle, if the mesh has tangents.
    #[inline]
    pub(super) fn tangent(&self, triangle: [u32; 3], barycentric: Vec2) -> Option<Vec4> {
        let tangents = self.shading.tangents.as_ref()?;
        Some(interpolate(
            triangle.map(|i| tangents[i as usize]),
            barycentric,
        ))
    }

    /// Which vertices triangle `index` has.
    #[inline]
    pub(super) fn vertices(&self, index: u32) -> [u32; 3] {
        let vertices = self.indices.get(index as usize);
        vertices.expect("only triangles that the mesh has are asked for")
    }

    #[inline]
    pub(super) fn corners(&self, triangle: [u32; 3]) -> [Vec3; 3] {
        triangle.map(|i| self.positions[i as usize])
    }

    #[inline]
    pub(super) fn normals(&self, triangle: [u32; 3]) -> Option<[Vec3; 3]> {
        let normals = self.normals.as_ref()?;
        Some(triangle.map(|i| normals[i as usize]))
    }

    /// The corners of all triangles.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [Vec3; 3]> {
        self.indices.iter().map(|triangle| self.corners(triangle))
    }
}

impl WorldMesh {
    /// The surface of a mesh light that rays hit, of a material. It is not validated.
    pub(crate) fn of_light(light: &LightDesc<Rgb>, material: usize) -> Option<Self> {
        match light {
            LightDesc::Mesh(light) if light.emission.mask != EmissionMask::Invisible => {
                Some(Self {
                    name: String::new(),
                    positions: light.positions.clone(),
                    normals: None,
                    uvs: light.uvs.clone(),
                    shading: ShadingAttributes::default(),
                    indices: light.indices.clone(),
                    material,
                })
            }
            _ => None,
        }
    }
}

impl From<Mesh> for WorldMesh {
    /// Vertices that triangles hardly share are stored per triangle, which saves the index lookup.
    fn from(mesh: Mesh) -> Self {
        let list = mesh.indices;
        let lies_apart = |vertex_bytes: usize, vertices: usize| {
            vertex_bytes * 3 * list.len() <= vertex_bytes * vertices + size_of_val(&*list)
        };
        let normal_bytes = mesh.normals.as_ref().map_or(0, |_| size_of::<Vec3>());
        let uv_bytes = mesh.uvs.as_ref().map_or(0, |_| size_of::<Vec2>());
        let vertex_bytes = size_of::<Vec3>() + normal_bytes + uv_bytes;
        let Mesh {
            second_uvs,
            tangents,
            colors,
            ..
        } = mesh;
        let count = u32::try_from(list.len()).ok();
        let count = count.filter(|_| lies_apart(vertex_bytes, mesh.positions.len()));
        let material = mesh.material.0 as usize;
        match count {
            Some(count) => Self {
                name: mesh.name,
                positions: of_triangles(&mesh.positions, &list),
                normals: mesh.normals.map(|normals| of_triangles(&normals, &list)),
                uvs: mesh.uvs.map(|uvs| of_triangles(&uvs, &list)),
                shading: ShadingAttributes {
                    second_uvs: second_uvs.map(|uvs| of_triangles(&uvs, &list)),
                    tangents: tangents.map(|tangents| of_triangles(&tangents, &list)),
                    colors: colors.map(|colors| of_triangles(&colors, &list)),
                },
                indices: MeshIndices::Consecutive(count),
                material,
            },
            None => Self {
                name: mesh.name,
                positions: mesh.positions.into(),
                normals: mesh.normals,
                uvs: mesh.uvs.map(Arc::from),
                shading: ShadingAttributes {
                    second_uvs,
                    tangents,
                    colors,
                },
                indices: list.into(),
                material,
            },
        }
    }
}

/// The value at a point between three corners, with the weights of the second and the third.
#[inline]
fn interpolate<T: Add<Output = T> + Mul<f32, Output = T>>([a, b, c]: [T; 3], at: Vec2) -> T {
    let Vec2 { x, y } = at;
    a * (1.0 - x - y) + b * x + c * y
}

/// Vertex attributes, three for each triangle.
fn of_triangles<T: Copy, L: FromIterator<T>>(vertices: &[T], triangles: &[[u32; 3]]) -> L {
    let corners = triangles.as_flattened().iter();
    corners.map(|&vertex| vertices[vertex as usize]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_scene::MaterialId;

    #[test]
    fn quads_are_stored_by_triangle_and_grids_by_vertex() {
        let quad = Mesh::quad("", MaterialId(0), [Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y]);
        let mut fan = quad.clone();
        fan.positions.push(Vec3::Z);
        fan.indices.extend([[0, 3, 4], [0, 4, 1], [1, 2, 4]]);
        for mesh in [quad, fan] {
            let triangles: Vec<_> = (0..mesh.indices.len()).map(|k| mesh.triangle(k)).collect();
            let is_quad = triangles.len() == 2;
            let made = WorldMesh::from(mesh);
            let consecutive = matches!(made.indices, MeshIndices::Consecutive(_));
            assert_eq!(consecutive, is_quad, "{} triangles", triangles.len());
            assert!(made.triangles().eq(triangles), "the same triangles");
        }
    }
}
