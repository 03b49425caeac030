//! Tangents of meshes whose files have none.

use std::collections::HashMap;

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};

use crate::glam::{Vec2, Vec3, Vec4};
use crate::{Mesh, UvSet};

/// The corners of all triangles, and the tangents that they get.
struct Corners<'a> {
    mesh: &'a Mesh,
    normals: &'a [Vec3],
    uvs: &'a [Vec2],
    tangents: Vec<[Vec4; 3]>,
}

/// Of a corner without a tangent: of a triangle, and of its neighbours, whose texture coordinates
/// are all the same.
const NONE: Vec4 = Vec4::W;

impl Mesh {
    /// Gives the mesh tangents for a normal map that uses these texture coordinates: those of
    /// MikkTSpace, with which such maps are made. A vertex whose triangles do not agree becomes
    /// several. Nothing without such coordinates, without normals, or where they are not finite.
    ///
    /// # Source
    /// `[GLTF]`, section 3.7.2.1; `[Mikkelsen2008]`.
    pub(crate) fn generate_tangents(&mut self, set: UvSet) {
        let uvs = match set {
            UvSet::First => &self.uvs,
            UvSet::Second => &self.second_uvs,
        };
        let (Some(normals), Some(uvs)) = (&self.normals, uvs) else {
            return;
        };
        let vectors = self.positions.iter().chain(normals);
        if !(vectors.copied().all(Vec3::is_finite) && uvs.iter().copied().all(Vec2::is_finite)) {
            return;
        }
        let mut corners = Corners {
            mesh: self,
            normals,
            uvs,
            tangents: vec![[NONE; 3]; self.indices.len()],
        };
        // There is no error that it could have.
        if generate_tangents(&mut corners).is_ok() {
            let tangents = corners.tangents;
            self.set_corner_tangents(&tangents);
        }
    }

    /// Gives each triangle its own tangents; vertices that no triangle uses are dropped.
    fn set_corner_tangents(&mut self, tangents: &[[Vec4; 3]]) {
        let mut known = HashMap::with_capacity(self.positions.len());
        let (mut sources, mut all) = (Vec::new(), Vec::new());
        for (triangle, tangents) in self.indices.iter_mut().zip(tangents) {
            for (corner, tangent) in triangle.iter_mut().zip(tangents) {
                let key = (*corner, tangent.to_array().map(f32::to_bits));
                *corner = *known.entry(key).or_insert_with(|| {
                    sources.push(*corner as usize);
                    all.push(*tangent);
                    // There are at most three for each of less than 2^27 triangles.
                    u32::try_from(all.len() - 1).unwrap_or(u32::MAX)
                });
            }
        }
        self.positions = gathered(&self.positions, &sources);
        let vectors = [&mut self.normals, &mut self.colors];
        for vectors in vectors.into_iter().flatten() {
            *vectors = gathered(vectors, &sources);
        }
        for uvs in [&mut self.uvs, &mut self.second_uvs].into_iter().flatten() {
            *uvs = gathered(uvs, &sources);
        }
        self.tangents = Some(all);
    }
}

fn gathered<T: Copy>(from: &[T], sources: &[usize]) -> Vec<T> {
    sources.iter().map(|&source| from[source]).collect()
}

impl Corners<'_> {
    fn vertex(&self, triangle: usize, corner: usize) -> usize {
        self.mesh.indices[triangle][corner] as usize
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.indices.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, triangle: usize, corner: usize) -> [f32; 3] {
        self.mesh.positions[self.vertex(triangle, corner)].to_array()
    }

    fn normal(&self, triangle: usize, corner: usize) -> [f32; 3] {
        self.normals[self.vertex(triangle, corner)].to_array()
    }

    fn tex_coord(&self, triangle: usize, corner: usize) -> [f32; 2] {
        self.uvs[self.vertex(triangle, corner)].to_array()
    }

    fn set_tangent(&mut self, tangent: Option<TangentSpace>, triangle: usize, corner: usize) {
        let tangent = tangent.map(|tangent| Vec4::from(tangent.tangent_encoded()));
        self.tangents[triangle][corner] = tangent.unwrap_or(NONE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MaterialId;

    /// A roof of two slopes that share their ridge, with smooth normals there; u runs across it.
    fn roof() -> Mesh {
        let mut mesh = Mesh::new("roof", MaterialId(0));
        let x = [-1.0, -1.0, 0.0, 0.0, 1.0, 1.0];
        let place = |(i, x): (usize, f32)| {
            let z = if i % 2 == 0 { 0.0 } else { 1.0 };
            (Vec3::new(x, 1.0 - x.abs(), z), Vec2::new(x, -z))
        };
        let (positions, uvs) = x.into_iter().enumerate().map(place).unzip();
        mesh.positions = positions;
        mesh.uvs = Some(uvs);
        let slope = |x: f32| Vec3::new(x, 1.0, 0.0).normalize();
        mesh.normals = Some(x.map(slope).to_vec());
        mesh.indices = vec![[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5]];
        mesh
    }

    #[test]
    fn tangents_follow_u_across_the_normals_and_are_shared() {
        let mut mesh = roof();
        mesh.generate_tangents(UvSet::First);
        assert_eq!(mesh.positions.len(), 6, "each vertex has one");
        let (tangents, normals) = (mesh.tangents.expect("tangents"), mesh.normals.expect("all"));
        for (i, (tangent, normal)) in tangents.iter().zip(&normals).enumerate() {
            let x = mesh.positions[i].x;
            // In the plane of x and y, at right angles to the normal; at the ridge that is the
            // mean of both slopes, where each alone would give its own.
            let expected = Vec3::new(normal.y, -normal.x, 0.0);
            let found = tangent.truncate();
            assert!(found.abs_diff_eq(expected, 1e-6), "{x}: {found}");
            // v runs toward -z.
            let bitangent = normal.cross(found) * tangent.w;
            assert!(bitangent.abs_diff_eq(Vec3::NEG_Z, 1e-6), "{x}: {bitangent}");
        }
    }

    #[test]
    fn a_seam_of_a_mirrored_image_parts_its_vertices() {
        let mut mesh = roof();
        // The image of the second slope runs back.
        let uvs = mesh.uvs.as_mut().expect("uvs");
        uvs[4].x = -1.0;
        uvs[5].x = -1.0;
        let before = mesh.clone();
        mesh.generate_tangents(UvSet::First);
        assert_eq!(mesh.positions.len(), 8, "two of the ridge twice");
        for triangle in 0..4 {
            assert_eq!(mesh.triangle(triangle), before.triangle(triangle));
        }
        let tangents = mesh.tangents.as_ref().expect("tangents");
        for (triangle, sign) in [(0, 1.0), (1, 1.0), (2, -1.0), (3, -1.0)] {
            for vertex in mesh.indices[triangle] {
                let tangent = tangents[vertex as usize];
                assert!(tangent.x * sign > 0.0, "{triangle}: {tangent}");
                assert_eq!(tangent.w, sign, "{triangle}: {tangent}");
            }
        }
    }

    #[test]
    fn what_has_no_coordinates_or_no_normals_stays_as_it_is() {
        let whole = roof();
        let flat = Mesh {
            normals: None,
            ..whole.clone()
        };
        let bare = Mesh {
            uvs: None,
            ..whole.clone()
        };
        let mut broken = whole.clone();
        broken.normals.as_mut().expect("normals")[1] = Vec3::NAN;
        for mesh in [flat, bare, broken] {
            let mut made = mesh.clone();
            made.generate_tangents(UvSet::First);
            assert_eq!(made.tangents, None);
        }
        let mut second = whole.clone();
        second.generate_tangents(UvSet::Second);
        assert_eq!(second, whole, "there are no second coordinates");
        // One place of the image on all of a triangle.
        let mut spot = whole;
        spot.uvs = Some(vec![Vec2::ONE; 6]);
        spot.generate_tangents(UvSet::First);
        assert_eq!(spot.indices.len(), 4);
    }
}
