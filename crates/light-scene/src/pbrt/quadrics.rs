use core::f32::consts::{PI, TAU};

use super::file_loc::Typed;
use super::state::Reader;
use crate::glam::{Affine3A, Vec3};
use crate::{Color, Diagnostic, Mesh, Sphere, SphereFront, Surface};

/// Of tessellated shapes: columns around; a sphere has half as many rows.
const AROUND: u16 = 64;

impl Reader {
    /// A whole sphere as one primitive; `None` for those that have to be tessellated.
    pub(super) fn whole_sphere(&mut self, typed: &Typed<'_>) -> Result<Option<Sphere>, Diagnostic> {
        let Parts { radius, z, turn } = Parts::of(typed);
        if !(radius > 0.0) {
            let message = format!("expected a positive radius, found {radius}");
            return Err(typed.at.diagnostic(message));
        }
        let is_whole = z == [-radius, radius] && turn == 1.0;
        let front = if self.turns_quadrics_over() {
            SphereFront::Inside
        } else {
            SphereFront::Outside
        };
        if !(is_whole && self.is_one_light(typed, front)) {
            return Ok(None);
        }
        let material = self.material();
        let unit = Sphere::new("sphere", material, Affine3A::IDENTITY);
        let transform = Affine3A::from_mat4(self.state.transform);
        let transform = transform * Affine3A::from_scale(Vec3::splat(radius));
        let sphere = unit.transformed(&transform);
        Ok(sphere.map(|sphere| Sphere { front, ..sphere }))
    }

    /// Whether a sphere, if it is emissive, has uniform emission that is visible on its near side.
    fn is_one_light(&mut self, typed: &Typed<'_>, front: SphereFront) -> bool {
        let Some(light) = self.state.area_light else {
            return true;
        };
        let material = self.material();
        let surface = &self.scene.material(material).surface;
        let lets_light_pass = matches!(surface, Surface::Interface | Surface::Mix { .. })
            || self.materials.awaits(material);
        let is_outside = !light.two_sided && front == SphereFront::Outside;
        let is_even = matches!(light.radiance, Color::Constant(_));
        is_even && (is_outside || !(lets_light_pass || typed.parameters.has("alpha")))
    }

    /// In pbrt a mirroring transform swaps front and back of quadrics, but not of meshes.
    pub(super) fn turns_quadrics_over(&self) -> bool {
        self.state.reversed ^ self.mirrors()
    }
}

/// The part of a sphere that is kept.
struct Parts {
    radius: f32,
    /// Its lowest and its highest z.
    z: [f32; 2],
    /// The part of a full turn.
    turn: f32,
}

impl Parts {
    fn of(typed: &Typed<'_>) -> Self {
        let parameters = &typed.parameters;
        let radius = parameters.positive_or("radius", 1.0);
        let z = [("zmin", -radius), ("zmax", radius)].map(|(name, all)| {
            let z = parameters.number_or(name, all);
            z.max(-radius).min(radius)
        });
        let z = [z[0].min(z[1]), z[0].max(z[1])];
        let turn = turn(typed);
        Self { radius, z, turn }
    }
}

/// The part of a full turn that `phimax` says.
fn turn(typed: &Typed<'_>) -> f32 {
    let phi_max = typed.parameters.positive_or("phimax", 360.0);
    phi_max.min(360.0) / 360.0
}

/// A sphere, or a part of one.
pub(super) fn sphere(typed: &Typed<'_>) -> Mesh {
    let Parts { radius, z, turn } = Parts::of(typed);
    // From the lower pole on.
    let [low, high] = z.map(|z| PI - (z / radius).clamp(-1.0, 1.0).acos());
    Mesh::grid([AROUND, AROUND / 2], |u, v| {
        let angle = low + (high - low) * v;
        let ((sin_phi, cos_phi), (sin, cos)) = ((u * turn * TAU).sin_cos(), angle.sin_cos());
        let normal = Vec3::new(sin * cos_phi, sin * sin_phi, -cos);
        (normal * radius, normal)
    })
}

pub(super) fn disk(typed: &Typed<'_>) -> Mesh {
    let radius = typed.parameters.positive_or("radius", 1.0);
    let height = typed.parameters.number_or("height", 0.0);
    let is_inside = |inner: f32| (0.0..radius).contains(&inner);
    let inner = typed
        .parameters
        .number_where("innerradius", is_inside, "from 0 to below `radius`");
    let inner = inner.unwrap_or(0.0);
    let turn = turn(typed);
    Mesh::grid([AROUND, 1], |u, v| {
        let (sin, cos) = (u * turn * TAU).sin_cos();
        let r = radius + (inner - radius) * v;
        (Vec3::new(r * cos, r * sin, height), Vec3::Z)
    })
}

pub(super) fn cylinder(typed: &Typed<'_>) -> Mesh {
    let radius = typed.parameters.positive_or("radius", 1.0);
    let low = typed.parameters.number_or("zmin", -1.0);
    let high = typed.parameters.number_or("zmax", 1.0);
    let (low, high) = (low.min(high), low.max(high));
    let turn = turn(typed);
    Mesh::grid([AROUND, 1], |u, v| {
        let (sin, cos) = (u * turn * TAU).sin_cos();
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

    /// Whether the area is `expected` but for what triangles cut off: of a circle of 64 corners a
    /// part of 0.0016, of a sphere a quarter more.
    fn has_area(shape: &str, expected: f32) {
        let area = mesh(shape).area();
        assert!(
            (area / expected - 1.0).abs() < 2.1e-3,
            "{shape}: {area}, not {expected}"
        );
    }

    #[test]
    fn parts_of_quadrics_have_their_areas() {
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
        has_area("\"disk\"", PI);
        has_area("\"cylinder\" \"float radius\" 3", 12.0 * PI);
        let zone = mesh("\"sphere\" \"float zmin\" .5").bounds();
        assert!(
            (zone.min.z - 0.5).abs() < 1e-6 && zone.max.z == 1.0,
            "{zone:?}"
        );
    }

    #[test]
    fn quadrics_emit_with_the_power_that_is_asked_for_or_that_of_their_area() {
        let shapes = [
            ("\"disk\" \"float radius\" 2", 4.0 * PI),
            (
                "\"disk\" \"float radius\" 2 \"float innerradius\" 1 \"float phimax\" 180",
                1.5 * PI,
            ),
            (
                "\"cylinder\" \"float zmin\" 0 \"float phimax\" 90",
                0.5 * PI,
            ),
        ];
        for (shape, area) in shapes {
            for (amount, expected) in [
                ("\"float power\" 10", 10.0),
                ("\"rgb L\" [ 3 3 3 ]", 3.0 * PI * area),
            ] {
                let text = format!("WorldBegin AreaLightSource \"diffuse\" {amount} Shape {shape}");
                let scene = parse_pbrt(Path::new("a"), &text, Files::NONE).expect("a scene");
                let mesh = &scene.meshes[0];
                let emission = scene.material(mesh.material).emission.as_ref();
                let Color::Constant(radiance) = emission.expect("a lamp").radiance else {
                    unreachable!("no image")
                };
                let power = PI * mesh.area() * radiance.y;
                assert!(
                    (power / expected - 1.0).abs() < 5e-3,
                    "{shape}, {amount}: {power} W, not {expected}"
                );
            }
        }
    }
}
