use alloc::sync::Arc;

use light_scene::Mesh;
use lights::bounds::LightId;
use lights::glam::{Vec2, Vec3};
use lights::sources::shape::Triangle;

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

impl WorldMesh {
    /// The texture coordinates on a triangle: those that its light has too.
    #[inline]
    pub(super) fn uv(&self, triangle: [u32; 3], barycentric: Vec2) -> Vec2 {
        let [a, b, c] = match &self.uvs {
            Some(uvs) => triangle.map(|i| uvs[i as usize]),
            None => Triangle::DEFAULT_UV,
        };
        let Vec2 { x, y } = barycentric;
        a * (1.0 - x - y) + b * x + c * y
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
        self.indices.iter().map(|&triangle| self.corners(triangle))
    }
}

impl From<Mesh> for WorldMesh {
    fn from(mesh: Mesh) -> Self {
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
