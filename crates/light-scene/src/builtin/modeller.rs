use std::collections::HashMap;

use crate::glam::{Affine3A, Vec2, Vec3};
use crate::{Material, MaterialId, Mesh, Scene};

/// Builds a scene from simple solids, one mesh per material and kind of shading.
#[derive(Debug, Default)]
pub(super) struct Modeller {
    scene: Scene,
    meshes: HashMap<(MaterialId, Shading), usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Shading {
    Flat,
    Smooth,
}

impl Modeller {
    pub(super) fn material(&mut self, material: Material) -> MaterialId {
        self.scene.add_material(material)
    }

    /// The number of emissive triangles so far.
    pub(super) fn emissive_triangle_count(&self) -> usize {
        self.scene.emissive_triangle_count()
    }

    /// Access to the scene for lights, images and the camera.
    pub(super) fn scene(&mut self) -> &mut Scene {
        &mut self.scene
    }

    pub(super) fn finish(self) -> Scene {
        self.scene
    }

    /// A flat quad, counter-clockwise seen from its front.
    pub(super) fn quad(&mut self, material: MaterialId, corners: [Vec3; 4]) {
        self.mesh(material, Shading::Flat).push_quad(corners);
    }

    /// A flat triangle, counter-clockwise seen from its front.
    pub(super) fn triangle(&mut self, material: MaterialId, corners: [Vec3; 3]) {
        self.mesh(material, Shading::Flat).push_triangle(corners);
    }

    /// An upright rectangle at depth `z` of `transform`, from corner `min` to corner `max`, facing
    /// +z.
    pub(super) fn panel(
        &mut self,
        material: MaterialId,
        transform: &Affine3A,
        min: Vec2,
        max: Vec2,
        z: f32,
    ) {
        let corner = |x, y| transform.transform_point3(Vec3::new(x, y, z));
        let corners = [
            corner(min.x, min.y),
            corner(max.x, min.y),
            corner(max.x, max.y),
            corner(min.x, max.y),
        ];
        self.quad(material, corners);
    }

    /// A box in the axes of `transform`.
    pub(super) fn block(
        &mut self,
        material: MaterialId,
        transform: &Affine3A,
        min: Vec3,
        max: Vec3,
    ) {
        let sides = [
            // Each face: its four corners as bits (x, y, z), 1 = max.
            [4, 6, 7, 5],
            [0, 1, 3, 2],
            [2, 3, 7, 6],
            [0, 4, 5, 1],
            [1, 5, 7, 3],
            [0, 2, 6, 4],
        ];
        let corner = |bits: u32| {
            let pick = |bit, low, high| if bits & bit == 0 { low } else { high };
            let x = pick(4, min.x, max.x);
            let y = pick(2, min.y, max.y);
            let z = pick(1, min.z, max.z);
            transform.transform_point3(Vec3::new(x, y, z))
        };
        for side in sides {
            self.quad(material, side.map(corner));
        }
    }

    /// A bar of `sides` flat faces from `a` to `b` whose thickness goes from radius `radius[0]` to
    /// `radius[1]`; open at both ends.
    pub(super) fn bar(
        &mut self,
        material: MaterialId,
        [a, b]: [Vec3; 2],
        radius: [f32; 2],
        sides: u16,
    ) {
        let Some(axis) = (b - a).try_normalize() else {
            return;
        };
        let (u, v) = axis.any_orthonormal_pair();
        let around = |k: u16| {
            let angle = core::f32::consts::TAU * f32::from(k) / f32::from(sides);
            u * angle.cos() + v * angle.sin()
        };
        for k in 0..sides {
            let (p, q) = (around(k), around(k + 1));
            let corners = [
                a + p * radius[0],
                a + q * radius[0],
                b + q * radius[1],
                b + p * radius[1],
            ];
            self.quad(material, corners);
        }
    }

    /// A bulb: eight triangles.
    pub(super) fn octahedron(&mut self, material: MaterialId, center: Vec3, radius: f32) {
        let tip = Vec3::Y * radius;
        let rim = [Vec3::X, Vec3::NEG_Z, Vec3::NEG_X, Vec3::Z, Vec3::X].map(|axis| axis * radius);
        for edge in rim.windows(2) {
            let (p, q) = (center + edge[0], center + edge[1]);
            self.triangle(material, [p, q, center + tip]);
            self.triangle(material, [q, p, center - tip]);
        }
    }

    /// A smooth solid of revolution around the y axis of `transform`: `profile` lists radius and
    /// height from the top down.
    pub(super) fn turned(
        &mut self,
        material: MaterialId,
        transform: &Affine3A,
        profile: &[Vec2],
        sides: u16,
    ) {
        let mesh = self.mesh(material, Shading::Smooth);
        let first = mesh.next_vertex();
        let Some(normals) = &mut mesh.normals else {
            return;
        };
        for k in 0..=sides {
            let angle = core::f32::consts::TAU * f32::from(k) / f32::from(sides);
            let out = Vec3::new(angle.cos(), 0.0, -angle.sin());
            for (i, at) in profile.iter().enumerate() {
                let before = profile[i.saturating_sub(1)];
                let after = profile[(i + 1).min(profile.len() - 1)];
                // The way down the profile, turned outward by a quarter.
                let way = after - before;
                let normal = out * -way.y + Vec3::Y * way.x;
                mesh.positions
                    .push(transform.transform_point3(out * at.x + Vec3::Y * at.y));
                normals.push(transform.transform_vector3(normal).normalize_or(Vec3::Y));
            }
        }
        let rows = u32::try_from(profile.len()).expect("a short profile");
        for k in 0..u32::from(sides) {
            for i in 0..rows - 1 {
                let (a, b) = (first + k * rows + i, first + (k + 1) * rows + i);
                mesh.indices.push([a, a + 1, b + 1]);
                mesh.indices.push([a, b + 1, b]);
            }
        }
    }

    /// A solid of revolution as [`turned`](Self::turned), but with an edge at every point of the
    /// profile.
    pub(super) fn turned_with_edges(
        &mut self,
        material: MaterialId,
        transform: &Affine3A,
        profile: &[Vec2],
        sides: u16,
    ) {
        for piece in profile.windows(2) {
            self.turned(material, transform, piece, sides);
        }
    }

    /// A smooth sphere.
    pub(super) fn sphere(&mut self, material: MaterialId, center: Vec3, radius: f32) {
        const ROWS: u16 = 48;
        let point = |k: u16| {
            let angle = core::f32::consts::PI * f32::from(k) / f32::from(ROWS);
            Vec2::new(angle.sin(), angle.cos()) * radius
        };
        let profile: Vec<Vec2> = (0..=ROWS).map(point).collect();
        let transform = Affine3A::from_translation(center);
        self.turned(material, &transform, &profile, 2 * ROWS);
    }

    fn mesh(&mut self, material: MaterialId, shading: Shading) -> &mut Mesh {
        let meshes = &mut self.scene.meshes;
        let materials = &self.scene.materials;
        let index = *self.meshes.entry((material, shading)).or_insert_with(|| {
            let name = materials[material.0 as usize].name.clone();
            let mut mesh = Mesh::new(name, material);
            mesh.normals = (shading == Shading::Smooth).then(Vec::new);
            meshes.push(mesh);
            meshes.len() - 1
        });
        &mut meshes[index]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume of a closed surface whose fronts face outward.
    fn volume(scene: &Scene) -> f32 {
        let meshes = scene.meshes.iter();
        let triangles = meshes.flat_map(|mesh| (0..mesh.indices.len()).map(|i| mesh.triangle(i)));
        triangles.map(|[a, b, c]| a.cross(b).dot(c)).sum::<f32>() / 6.0
    }

    fn model(build: impl FnOnce(&mut Modeller, MaterialId)) -> Scene {
        let mut modeller = Modeller::default();
        let grey = modeller.material(Material::diffuse("grey", Vec3::splat(0.5)));
        build(&mut modeller, grey);
        modeller.finish()
    }

    #[test]
    fn solids_face_outward_and_have_their_volume() {
        let transform = Affine3A::from_translation(Vec3::new(3.0, 1.0, -2.0));
        let block =
            model(|m, grey| m.block(grey, &transform, Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0)));
        assert!((volume(&block) - 6.0).abs() < 1e-4, "1 x 2 x 3");
        let bulb = model(|m, grey| m.octahedron(grey, Vec3::ONE, 0.5));
        assert!((volume(&bulb) - 4.0 / 3.0 * 0.125).abs() < 1e-4, "4/3 r^3");
        let ball = model(|m, grey| m.sphere(grey, Vec3::ONE, 1.0));
        let exact = 4.0 / 3.0 * core::f32::consts::PI;
        assert!((volume(&ball) / exact - 1.0).abs() < 0.01, "4/3 pi r^3");
        let normals = ball.meshes[0].normals.as_ref().expect("smooth");
        for (p, n) in ball.meshes[0].positions.iter().zip(normals) {
            assert!(n.dot(*p - Vec3::ONE) > 0.99, "normals point outward");
        }
    }

    #[test]
    fn a_bar_faces_outward() {
        let bar = model(|m, grey| m.bar(grey, [Vec3::ZERO, Vec3::Y * 2.0], [0.1, 0.1], 6));
        for index in 0..bar.triangle_count() {
            let [a, b, c] = bar.meshes[0].triangle(index);
            let out = (a + b + c) * Vec3::new(1.0, 0.0, 1.0);
            assert!((b - a).cross(c - a).dot(out) > 0.0, "outward");
        }
    }
}
