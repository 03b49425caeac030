//! Round shapes made of triangles.

use super::state::Typed;
use crate::Mesh;
use crate::glam::{Vec2, Vec3};

/// Of a sphere: columns around; it has half as many rows.
const AROUND: u16 = 64;

/// A grid of vertices over the unit square of (u, v); `point` gives position and normal, u runs counter-clockwise
/// around v seen from the front.
fn grid(columns: u16, rows: u16, point: impl Fn(f32, f32) -> (Vec3, Vec3)) -> Mesh {
    let mut mesh = Mesh::new("", crate::MaterialId(0));
    let (mut normals, mut uvs) = (Vec::new(), Vec::new());
    for row in 0..=rows {
        for column in 0..=columns {
            let uv = Vec2::new(
                f32::from(column) / f32::from(columns),
                f32::from(row) / f32::from(rows),
            );
            let (position, normal) = point(uv.x, uv.y);
            mesh.positions.push(position);
            normals.push(normal);
            uvs.push(uv);
        }
    }
    let (across, up) = (u32::from(columns), u32::from(rows));
    for row in 0..up {
        for column in 0..across {
            let a = row * (across + 1) + column;
            let b = a + across + 1;
            mesh.indices.push([a, a + 1, b + 1]);
            mesh.indices.push([a, b + 1, b]);
        }
    }
    (mesh.normals, mesh.uvs) = (Some(normals), Some(uvs));
    mesh
}

/// How far a quadric goes around the z axis, in radians.
fn turn(typed: &Typed<'_>) -> f32 {
    let degrees = typed.parameters.number_or("phimax", 360.0);
    degrees.clamp(0.0, 360.0).to_radians()
}

pub(super) fn sphere(typed: &Typed<'_>) -> Mesh {
    let radius = typed.parameters.number_or("radius", 1.0);
    let [low, high] = [("zmin", -radius), ("zmax", radius)].map(|(name, all)| {
        let z = typed.parameters.number_or(name, all);
        (-z / radius).clamp(-1.0, 1.0).acos()
    });
    let turn = turn(typed);
    grid(AROUND, AROUND / 2, |u, v| {
        let ((sin_phi, cos_phi), (sin, cos)) =
            ((u * turn).sin_cos(), (low + (high - low) * v).sin_cos());
        let normal = Vec3::new(sin * cos_phi, sin * sin_phi, -cos);
        (normal * radius, normal)
    })
}

pub(super) fn disk(typed: &Typed<'_>) -> Mesh {
    let radius = typed.parameters.number_or("radius", 1.0);
    let height = typed.parameters.number_or("height", 0.0);
    let inner = typed.parameters.number_or("innerradius", 0.0);
    let turn = turn(typed);
    grid(AROUND, 1, |u, v| {
        let (sin, cos) = (u * turn).sin_cos();
        let r = radius + (inner - radius) * v;
        (Vec3::new(r * cos, r * sin, height), Vec3::Z)
    })
}

pub(super) fn cylinder(typed: &Typed<'_>) -> Mesh {
    let radius = typed.parameters.number_or("radius", 1.0);
    let low = typed.parameters.number_or("zmin", -1.0);
    let high = typed.parameters.number_or("zmax", 1.0);
    let turn = turn(typed);
    grid(AROUND, 1, |u, v| {
        let (sin, cos) = (u * turn).sin_cos();
        let normal = Vec3::new(cos, sin, 0.0);
        (normal * radius + Vec3::Z * (low + (high - low) * v), normal)
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::parse_pbrt;
    use super::*;
    use crate::Files;

    fn mesh(shape: &str) -> Mesh {
        let text = format!("WorldBegin Shape {shape}");
        let scene = parse_pbrt(Path::new("a"), &text, Files::NONE).expect("a scene");
        assert_eq!(
            scene.warnings.len(),
            1,
            "made of triangles: {:?}",
            scene.warnings
        );
        scene.meshes[0].clone()
    }

    /// Whether the area is `expected` but for what triangles cut off: of a circle of 64 corners a part of 0.0016, of a sphere a
    /// quarter more.
    fn has_area(shape: &str, expected: f32) {
        let area = mesh(shape).area();
        assert!(
            (area / expected - 1.0).abs() < 2.1e-3,
            "{shape}: {area}, not {expected}"
        );
    }

    #[test]
    fn parts_of_quadrics_have_their_areas() {
        use core::f32::consts::PI;
        has_area("\"sphere\" \"float radius\" 2", 16.0 * PI);
        has_area(
            "\"sphere\" \"float radius\" 2 \"float phimax\" 90",
            4.0 * PI,
        );
        // A zone has the area of the cylinder around it.
        has_area(
            "\"sphere\" \"float radius\" 2 \"float zmin\" -1 \"float zmax\" 1.5",
            10.0 * PI,
        );
        has_area(
            "\"disk\" \"float radius\" 2 \"float innerradius\" 1 \"float phimax\" 180",
            1.5 * PI,
        );
        has_area(
            "\"cylinder\" \"float zmin\" 0 \"float phimax\" 90",
            0.5 * PI,
        );
        let zone = mesh("\"sphere\" \"float zmin\" .5").bounds();
        assert!(
            (zone.min.z - 0.5).abs() < 1e-6 && zone.max.z == 1.0,
            "{zone:?}"
        );
    }
}
