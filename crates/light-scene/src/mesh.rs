use lights::math::Aabb;

use crate::MaterialId;
use crate::glam::{Affine3A, Vec2, Vec3, Vec4};

/// Triangles of one material.
///
/// Seen from their front the vertices of a triangle run counter-clockwise: the front normal is
/// `cross(p1 - p0, p2 - p0)`, and it is the side on which a one-sided emitter emits.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Mesh {
    /// The group's name in the file; may be empty.
    pub name: String,
    /// The material of the triangles.
    pub material: MaterialId,
    /// Positions of the vertices, in scene units.
    pub positions: Vec<Vec3>,
    /// Shading normals, one per vertex, not necessarily of unit length; absent for flat shading.
    pub normals: Option<Vec<Vec3>>,
    /// Texture coordinates, one per vertex; (0, 0) is the lower left corner of an image.
    pub uvs: Option<Vec<Vec2>>,
    /// Texture coordinates for images that ask for the second ones, one per vertex.
    pub second_uvs: Option<Vec<Vec2>>,
    /// Tangents for the normal map, one per vertex: a direction, and 1 or -1. The bitangent is that
    /// number times `cross(normal, direction)`. Without them they are made of the texture
    /// coordinates that the map uses.
    pub tangents: Option<Vec<Vec4>>,
    /// Linear RGB in `[0, 1]`, one per vertex, that multiplies the colour of surfaces that are
    /// matt, coated or metallic by a base colour; emission stays as it is.
    pub colors: Option<Vec<Vec3>>,
    /// Three vertices per triangle, each below `positions.len()`.
    pub indices: Vec<[u32; 3]>,
}

impl Mesh {
    /// A mesh without triangles.
    #[must_use]
    pub fn new(name: impl Into<String>, material: MaterialId) -> Self {
        Self {
            name: name.into(),
            material,
            positions: Vec::new(),
            normals: None,
            uvs: None,
            second_uvs: None,
            tangents: None,
            colors: None,
            indices: Vec::new(),
        }
    }

    /// Two triangles over four corners, counter-clockwise seen from the front.
    #[must_use]
    pub fn quad(name: impl Into<String>, material: MaterialId, corners: [Vec3; 4]) -> Self {
        let mut mesh = Self::new(name, material);
        mesh.push_quad(corners);
        mesh
    }

    /// Adds two triangles over four corners, counter-clockwise seen from the front; the mesh must
    /// be flat shaded.
    pub fn push_quad(&mut self, corners: [Vec3; 4]) {
        let first = self.next_vertex();
        self.positions.extend(corners);
        self.indices.push([first, first + 1, first + 2]);
        self.indices.push([first, first + 2, first + 3]);
    }

    /// Adds one triangle, counter-clockwise seen from the front; the mesh must be flat shaded.
    pub(crate) fn push_triangle(&mut self, corners: [Vec3; 3]) {
        let first = self.next_vertex();
        self.positions.extend(corners);
        self.indices.push([first, first + 1, first + 2]);
    }

    /// The box around all vertices.
    #[must_use]
    pub fn bounds(&self) -> Aabb {
        Aabb::from_points(self.positions.iter().copied())
    }

    /// The corners of a triangle.
    ///
    /// # Panics
    /// Panics if there is no such triangle.
    #[must_use]
    pub fn triangle(&self, index: usize) -> [Vec3; 3] {
        self.indices[index].map(|vertex| self.positions[vertex as usize])
    }

    /// The area of all triangles, in scene units squared.
    #[must_use]
    pub fn area(&self) -> f32 {
        let triangles = (0..self.indices.len()).map(|index| self.triangle(index));
        let doubled = triangles.map(|[a, b, c]| (b - a).cross(c - a).length());
        0.5 * doubled.sum::<f32>()
    }

    /// The mesh under `transform`. The front of a triangle stays its front, even if `transform`
    /// mirrors.
    #[must_use]
    pub fn transformed(&self, transform: &Affine3A) -> Self {
        let normal_matrix = transform.matrix3.inverse().transpose();
        let mut mesh = self.clone();
        for position in &mut mesh.positions {
            *position = transform.transform_point3(*position);
        }
        for normal in mesh.normals.iter_mut().flatten() {
            *normal = (normal_matrix * *normal).normalize_or_zero();
        }
        let mirrors = transform.matrix3.determinant() < 0.0;
        let side = if mirrors { -1.0 } else { 1.0 };
        for tangent in mesh.tangents.iter_mut().flatten() {
            let direction = transform.transform_vector3(tangent.truncate());
            *tangent = direction.normalize_or_zero().extend(tangent.w * side);
        }
        if mirrors {
            mesh.turn_triangles();
        }
        mesh
    }

    /// Swaps front and back.
    pub(crate) fn turn_over(&mut self) {
        self.turn_triangles();
        for normal in self.normals.iter_mut().flatten() {
            *normal = -*normal;
        }
        // The bitangent stays.
        for tangent in self.tangents.iter_mut().flatten() {
            tangent.w = -tangent.w;
        }
    }

    /// Removes the triangles without area: no ray hits them, and they have no front.
    pub(crate) fn drop_empty_triangles(&mut self) {
        let positions = &self.positions;
        self.indices.retain(|triangle| {
            let [a, b, c] = triangle.map(|i| positions[i as usize]);
            (b - a).cross(c - a).length_squared() > 0.0
        });
    }

    /// Makes normals that are not finite 0, where shading is flat, and returns how many.
    pub(crate) fn drop_broken_normals(&mut self) -> usize {
        let broken = self.normals.iter_mut().flatten().filter(|n| !n.is_finite());
        broken.map(|normal| *normal = Vec3::ZERO).count()
    }

    /// Turns every triangle so that its front is where its normals point, if it has normals.
    pub(crate) fn align_with_normals(&mut self) {
        let Some(normals) = &self.normals else {
            return;
        };
        for triangle in &mut self.indices {
            let [a, b, c] = triangle.map(|i| self.positions[i as usize]);
            let normal: Vec3 = triangle.iter().map(|&i| normals[i as usize]).sum();
            if (b - a).cross(c - a).dot(normal) < 0.0 {
                triangle.swap(1, 2);
            }
        }
    }

    fn turn_triangles(&mut self) {
        for [_, b, c] in &mut self.indices {
            core::mem::swap(b, c);
        }
    }

    /// The index that the next vertex gets.
    ///
    /// # Panics
    /// Panics at 2^32 vertices.
    pub(crate) fn next_vertex(&self) -> u32 {
        u32::try_from(self.positions.len()).expect("fewer than 2^32 vertices in a mesh")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_without_area_are_dropped() {
        let mut mesh = Mesh::new("m", MaterialId(0));
        mesh.push_triangle([Vec3::ZERO, Vec3::X, Vec3::X * 2.0]);
        mesh.push_triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
        mesh.drop_empty_triangles();
        assert_eq!(mesh.indices, [[3, 4, 5]], "the second one stays");
    }

    #[test]
    fn moving_keeps_the_front() {
        let mesh = Mesh::quad(
            "q",
            MaterialId(0),
            [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y],
        );
        let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
        let mut moved = mesh.transformed(&mirror);
        let [a, b, c] = moved.triangle(0);
        assert_eq!((b - a).cross(c - a), Vec3::Z, "still +z");
        moved.turn_over();
        let [a, b, c] = moved.triangle(0);
        assert_eq!((b - a).cross(c - a), Vec3::NEG_Z, "turned");
    }

    #[test]
    fn a_quad_is_two_triangles_with_one_front() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
        let mesh = Mesh::quad("q", MaterialId(0), corners);
        assert_eq!(mesh.indices.len(), 2, "two triangles");
        assert_eq!(mesh.area(), 1.0, "unit square");
        for index in 0..2 {
            let [a, b, c] = mesh.triangle(index);
            assert_eq!((b - a).cross(c - a), Vec3::Z, "front is +z");
        }
    }
}
