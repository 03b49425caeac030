use core::f32::consts::{PI, TAU};

use lights::math::Aabb;
use lights::sources::shape::ShapeDesc;

use crate::glam::{Affine3A, Mat3A, Vec3};
use crate::{MaterialId, Mesh, QuadricKind, QuadricPart};

/// A sphere, disk or cylinder of one material, whole or in part: round, not made of triangles.
///
/// Its texture coordinates are those of [`Mesh`]es that readers make of such shapes: u runs around
/// the axis +z of `transform`, v from the lower pole or rim to the upper, of a disk from the rim
/// inward.
///
/// An emissive one is one light. Light samples only find the part of a sphere or cylinder that is
/// visible, so that inside emission through an alpha mask or a
/// [`Surface::Interface`](crate::Surface::Interface) is noisier. No light has the shape of a part:
/// one that emits is rendered as its [`mesh`](Self::mesh).
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Quadric {
    /// The name in the file; may be empty.
    pub name: String,
    /// Its material.
    pub material: MaterialId,
    /// Which shape it is.
    pub kind: QuadricKind,
    /// The part of it that is there; `None` for all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<QuadricPart>,
    /// From the space of `kind` to the scene: a rotation or reflection with uniform scale and
    /// translation.
    pub transform: Affine3A,
    /// Which side is the front, on which a one-sided emitter emits.
    pub front: QuadricFront,
}

/// The front of a quadric.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub enum QuadricFront {
    /// Its outside.
    #[default]
    Outside,
    /// Its inside.
    Inside,
}

impl Quadric {
    /// The shape under `transform`, with its front outside.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        material: MaterialId,
        kind: QuadricKind,
        transform: Affine3A,
    ) -> Self {
        Self {
            name: name.into(),
            material,
            kind,
            part: None,
            transform,
            front: QuadricFront::Outside,
        }
    }

    /// The unit sphere under `transform`, with its front outside.
    #[must_use]
    pub fn sphere(name: impl Into<String>, material: MaterialId, transform: Affine3A) -> Self {
        Self::new(name, material, QuadricKind::Sphere, transform)
    }

    /// The centre.
    #[must_use]
    pub fn center(&self) -> Vec3 {
        self.transform.translation.into()
    }

    /// The radius, in scene units.
    #[must_use]
    pub fn radius(&self) -> f32 {
        self.transform.matrix3.z_axis.length()
    }

    /// The area, in scene units squared.
    #[must_use]
    pub fn area(&self) -> f32 {
        let of_unit = match self.kind {
            QuadricKind::Sphere => 4.0 * PI,
            QuadricKind::Disk { inner_radius } => PI * (1.0 - inner_radius * inner_radius),
            QuadricKind::Cylinder { length } => TAU * length,
        };
        let share = self.part.map_or(1.0, |part| part.area_share(self.kind));
        of_unit * share * self.radius() * self.radius()
    }

    /// A box around it: the smallest, unless it is a part.
    #[must_use]
    pub fn bounds(&self) -> Aabb {
        let whole = self.bounds_of_whole();
        let Some(part) = self.part else {
            return whole;
        };
        let Aabb { min, max } = part.bounds(self.kind);
        let center = self.transform.transform_point3(0.5 * (min + max));
        let half = 0.5 * (max - min);
        let Mat3A {
            x_axis,
            y_axis,
            z_axis,
        } = self.transform.matrix3;
        let reach = x_axis.abs() * half.x + y_axis.abs() * half.y + z_axis.abs() * half.z;
        let reach = Vec3::from(reach);
        Aabb {
            min: whole.min.max(center - reach),
            max: whole.max.min(center + reach),
        }
    }

    fn bounds_of_whole(&self) -> Aabb {
        let radius = self.radius();
        let axis = Vec3::from(self.transform.matrix3.z_axis) / radius;
        // How far the rim of a disk reaches along each axis of the scene.
        let rim = || (Vec3::ONE - axis * axis).max(Vec3::ZERO).map(f32::sqrt);
        let reach = match self.kind {
            QuadricKind::Sphere => Vec3::ONE,
            QuadricKind::Disk { .. } => rim(),
            QuadricKind::Cylinder { length } => rim() + axis.abs() * (0.5 * length),
        };
        Aabb {
            min: self.center() - reach * radius,
            max: self.center() + reach * radius,
        }
    }

    /// The shape of a light with the surface of the whole; it is invalid where `transform` does not keep
    /// angles.
    #[must_use]
    pub fn shape(&self) -> ShapeDesc {
        let Affine3A {
            matrix3:
                Mat3A {
                    x_axis,
                    y_axis,
                    z_axis,
                },
            translation,
        } = self.transform;
        let radius = self.radius();
        let axes = [x_axis, y_axis, z_axis].map(|axis| axis / radius);
        let transform = Affine3A {
            matrix3: Mat3A::from_cols(axes[0], axes[1], axes[2]),
            translation,
        };
        match self.kind {
            QuadricKind::Sphere => ShapeDesc::Sphere { transform, radius },
            QuadricKind::Disk { inner_radius } => ShapeDesc::Disk {
                transform,
                radius,
                inner_radius: inner_radius * radius,
            },
            QuadricKind::Cylinder { length } => ShapeDesc::Cylinder {
                transform,
                radius,
                length: length * radius,
            },
        }
    }

    /// The shape under `transform`, with the same front; `None` if it would become another one, as
    /// a sphere that is stretched. A cylinder may be stretched along its axis, and what happens
    /// across a disk does not matter.
    #[must_use]
    pub fn transformed(&self, transform: &Affine3A) -> Option<Self> {
        let mut moved = Self {
            transform: *transform * self.transform,
            ..self.clone()
        };
        moved.scale_axis();
        moved.shape().build().is_ok().then_some(moved)
    }

    /// Gives the axis of a disk or cylinder the length of the radius across.
    fn scale_axis(&mut self) {
        let Mat3A {
            x_axis,
            y_axis,
            z_axis,
        } = &mut self.transform.matrix3;
        let radius = x_axis.length();
        match &mut self.kind {
            QuadricKind::Sphere => {}
            QuadricKind::Disk { .. } => {
                let normal = x_axis.cross(*y_axis).normalize_or_zero();
                *z_axis = normal * (radius * normal.dot(*z_axis).signum());
            }
            QuadricKind::Cylinder { length } => {
                let stretch = z_axis.length() / radius;
                *length *= stretch;
                *z_axis /= stretch;
            }
        }
    }

    /// Triangles that replace it: `columns` around, and half as many rows of a sphere.
    #[must_use]
    pub fn mesh(&self, columns: u16) -> Mesh {
        let around = |u: f32| {
            let (sin, cos) = (u * TAU).sin_cos();
            Vec3::new(cos, sin, 0.0)
        };
        let all = QuadricPart {
            turn: 1.0,
            v: [0.0, 1.0],
        };
        let part = self.part.unwrap_or(all);
        let grid = |rows, point: &dyn Fn(f32, f32) -> (Vec3, Vec3)| {
            Mesh::grid([columns, rows], |u, v| {
                let [u, v] = part.of_whole([u, v]);
                point(u, v)
            })
        };
        let unit = match self.kind {
            QuadricKind::Sphere => grid(columns / 2, &|u, v| {
                let (sin, cos) = (v * PI).sin_cos();
                // Not below 0, to which the sine of pi is rounded.
                let normal = around(u) * sin.max(0.0) - Vec3::Z * cos;
                (normal, normal)
            }),
            QuadricKind::Disk { inner_radius } => grid(1, &|u, v| {
                (around(u) * (1.0 + (inner_radius - 1.0) * v), Vec3::Z)
            }),
            QuadricKind::Cylinder { length } => grid(1, &|u, v| {
                (around(u) + Vec3::Z * (length * (v - 0.5)), around(u))
            }),
        };
        let mut mesh = unit.transformed(&self.transform);
        mesh.drop_empty_triangles();
        if self.front == QuadricFront::Inside {
            mesh.turn_over();
        }
        mesh.name.clone_from(&self.name);
        mesh.material = self.material;
        mesh
    }
}

#[cfg(test)]
mod tests;
