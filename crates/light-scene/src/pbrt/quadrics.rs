use core::f32::consts::{PI, TAU};

use super::file_loc::Typed;
use super::state::Reader;
use crate::glam::{Affine3A, Vec3};
use crate::{Color, Diagnostic, Mesh, Quadric, QuadricFront, QuadricKind, Surface};

/// Of tessellated shapes: columns around; a sphere has half as many rows.
const AROUND: u16 = 64;

impl Reader {
    /// A whole sphere, disk or cylinder as one primitive; `None` for other shapes, and for parts of
    /// these, which have to be tessellated.
    pub(super) fn whole_quadric(
        &mut self,
        typed: &Typed<'_>,
    ) -> Result<Option<Quadric>, Diagnostic> {
        let unit = match typed.kind.as_str() {
            "sphere" => Parts::of(typed).whole(),
            "disk" => DiskParts::of(typed).whole(),
            "cylinder" => CylinderParts::of(typed).whole(),
            _ => return Ok(None),
        };
        let radius = typed.parameters.positive_or("radius", 1.0);
        if !(radius > 0.0) {
            let message = format!("expected a positive radius, found {radius}");
            return Err(typed.at.diagnostic(message));
        }
        let front = if self.turns_quadrics_over() {
            QuadricFront::Inside
        } else {
            QuadricFront::Outside
        };
        let Some((kind, z)) = unit else {
            return Ok(None);
        };
        if !self.is_one_light(typed, kind, front) {
            return Ok(None);
        }
        let unit = Quadric::new(
            typed.kind.as_str(),
            self.material(),
            kind,
            Affine3A::IDENTITY,
        );
        let local = Affine3A::from_translation(Vec3::Z * z);
        let local = local * Affine3A::from_scale(Vec3::splat(radius));
        let transform = Affine3A::from_mat4(self.state.transform) * local;
        let quadric = unit.transformed(&transform);
        Ok(quadric.map(|quadric| Quadric { front, ..quadric }))
    }

    /// Whether a quadric, if it is emissive, has uniform emission that is visible where light
    /// samples find it.
    fn is_one_light(&mut self, typed: &Typed<'_>, kind: QuadricKind, front: QuadricFront) -> bool {
        let Some(light) = self.state.area_light else {
            return true;
        };
        let material = self.material();
        let surface = &self.scene.material(material).surface;
        let lets_light_pass = matches!(surface, Surface::Interface | Surface::Mix { .. })
            || self.materials.awaits(material);
        // Nothing of a disk is behind another part of it. Of a sphere that no ray meets pbrt takes
        // the near side alone, of other shapes all.
        let is_flat = matches!(kind, QuadricKind::Disk { .. });
        let is_invisible = self.share(typed, "alpha", 1.0) == Color::Constant(Vec3::ZERO);
        let has_near_side_alone = kind == QuadricKind::Sphere && is_invisible;
        let is_outside = !light.two_sided && front == QuadricFront::Outside;
        let is_even = matches!(light.radiance, Color::Constant(_));
        let is_found = is_flat || is_outside || has_near_side_alone;
        is_even && (is_found || !(lets_light_pass || typed.parameters.has("alpha")))
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

    /// The kind of the whole shape, and the height of its centre.
    fn whole(&self) -> Option<(QuadricKind, f32)> {
        let is_whole = self.z == [-self.radius, self.radius] && self.turn == 1.0;
        is_whole.then_some((QuadricKind::Sphere, 0.0))
    }
}

/// A disk, an annulus, or a part of one.
struct DiskParts {
    radius: f32,
    inner: f32,
    height: f32,
    turn: f32,
}

impl DiskParts {
    fn of(typed: &Typed<'_>) -> Self {
        let parameters = &typed.parameters;
        let radius = parameters.positive_or("radius", 1.0);
        let is_inside = |inner: f32| (0.0..radius).contains(&inner);
        let inner = parameters.number_where("innerradius", is_inside, "from 0 to below `radius`");
        Self {
            radius,
            inner: inner.unwrap_or(0.0),
            height: parameters.number_or("height", 0.0),
            turn: turn(typed),
        }
    }

    /// The kind of the whole shape, and the height of its centre.
    fn whole(&self) -> Option<(QuadricKind, f32)> {
        let inner_radius = self.inner / self.radius;
        let kind = QuadricKind::Disk { inner_radius };
        (self.turn == 1.0).then_some((kind, self.height))
    }
}

/// A cylinder, or a part of one.
struct CylinderParts {
    radius: f32,
    /// Its lowest and its highest z.
    z: [f32; 2],
    turn: f32,
}

impl CylinderParts {
    fn of(typed: &Typed<'_>) -> Self {
        let parameters = &typed.parameters;
        let z = [("zmin", -1.0), ("zmax", 1.0)];
        let z = z.map(|(name, default)| parameters.number_or(name, default));
        Self {
            radius: parameters.positive_or("radius", 1.0),
            z: [z[0].min(z[1]), z[0].max(z[1])],
            turn: turn(typed),
        }
    }

    /// The kind of the whole shape, and the height of its centre.
    fn whole(&self) -> Option<(QuadricKind, f32)> {
        let [low, high] = self.z;
        let length = (high - low) / self.radius;
        let kind = QuadricKind::Cylinder { length };
        (self.turn == 1.0).then_some((kind, low + 0.5 * (high - low)))
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
    let DiskParts {
        radius,
        inner,
        height,
        turn,
    } = DiskParts::of(typed);
    Mesh::grid([AROUND, 1], |u, v| {
        let (sin, cos) = (u * turn * TAU).sin_cos();
        let r = radius + (inner - radius) * v;
        (Vec3::new(r * cos, r * sin, height), Vec3::Z)
    })
}

pub(super) fn cylinder(typed: &Typed<'_>) -> Mesh {
    let CylinderParts {
        radius,
        z: [low, high],
        turn,
    } = CylinderParts::of(typed);
    Mesh::grid([AROUND, 1], |u, v| {
        let (sin, cos) = (u * turn * TAU).sin_cos();
        let normal = Vec3::new(cos, sin, 0.0);
        (normal * radius + Vec3::Z * (low + (high - low) * v), normal)
    })
}
