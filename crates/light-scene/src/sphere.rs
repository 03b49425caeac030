use core::f32::consts::{PI, TAU};

use lights::math::Aabb;
use lights::sources::shape::ShapeDesc;

use crate::glam::{Affine3A, Mat3A, Vec3};
use crate::{MaterialId, Mesh};

/// A whole sphere of one material: round, not made of triangles.
///
/// Its texture coordinates are those of [`Mesh`]es that readers make of spheres: u runs around the
/// axis +z of `transform`, v from the lower pole to the upper.
///
/// An emissive sphere is one light. Light samples only find its near side, so that inside emission
/// through an alpha mask or a [`Surface::Interface`](crate::Surface::Interface) is noisier.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Sphere {
    /// The name in the file; may be empty.
    pub name: String,
    /// Its material.
    pub material: MaterialId,
    /// From the unit sphere around the origin to the scene: a rotation or reflection with uniform
    /// scale and translation.
    pub transform: Affine3A,
    /// Which side is the front, on which a one-sided emitter emits.
    pub front: SphereFront,
}

/// The front of a sphere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub enum SphereFront {
    /// Its outside.
    #[default]
    Outside,
    /// Its inside.
    Inside,
}

impl Sphere {
    /// The unit sphere under `transform`, with its front outside.
    #[must_use]
    pub fn new(name: impl Into<String>, material: MaterialId, transform: Affine3A) -> Self {
        Self {
            name: name.into(),
            material,
            transform,
            front: SphereFront::Outside,
        }
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
        4.0 * PI * self.radius() * self.radius()
    }

    /// The box around it.
    #[must_use]
    pub fn bounds(&self) -> Aabb {
        Aabb {
            min: self.center() - self.radius(),
            max: self.center() + self.radius(),
        }
    }

    /// The shape of a light with this surface; it is invalid where `transform` does not keep
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
        ShapeDesc::Sphere {
            transform: Affine3A {
                matrix3: Mat3A::from_cols(axes[0], axes[1], axes[2]),
                translation,
            },
            radius,
        }
    }

    /// The sphere under `transform`, with the same front; `None` if it would not stay a sphere.
    #[must_use]
    pub fn transformed(&self, transform: &Affine3A) -> Option<Self> {
        let moved = Self {
            transform: *transform * self.transform,
            ..self.clone()
        };
        moved.shape().build().is_ok().then_some(moved)
    }

    /// Triangles that replace it: `columns` around, and half as many rows.
    #[must_use]
    pub fn mesh(&self, columns: u16) -> Mesh {
        let unit = Mesh::grid([columns, columns / 2], |u, v| {
            let ((sin_phi, cos_phi), (sin, cos)) = ((u * TAU).sin_cos(), (v * PI).sin_cos());
            let normal = Vec3::new(sin * cos_phi, sin * sin_phi, -cos);
            (normal, normal)
        });
        let mut mesh = unit.transformed(&self.transform);
        mesh.drop_empty_triangles();
        if self.front == SphereFront::Inside {
            mesh.turn_over();
        }
        mesh.name.clone_from(&self.name);
        mesh.material = self.material;
        mesh
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sphere() -> Sphere {
        let turn = Affine3A::from_axis_angle(Vec3::new(1.0, 2.0, 2.0) / 3.0, 0.8);
        let scale = Affine3A::from_scale(Vec3::splat(2.0));
        let transform = Affine3A::from_translation(Vec3::new(5.0, 0.0, -1.0)) * turn * scale;
        Sphere::new("ball", MaterialId(0), transform)
    }

    #[test]
    fn it_is_where_its_triangles_are() {
        let sphere = sphere();
        assert!((sphere.radius() - 2.0).abs() < 1e-6, "scaled");
        let mesh = sphere.mesh(128);
        for p in &mesh.positions {
            let distance = p.distance(sphere.center());
            assert!((distance - 2.0).abs() < 1e-5, "{p} lies on it");
        }
        assert!((mesh.area() / sphere.area() - 1.0).abs() < 2e-3, "area");
        let bounds = mesh.bounds();
        let off =
            (bounds.min - sphere.bounds().min).abs() + (bounds.max - sphere.bounds().max).abs();
        assert!(off.max_element() < 2e-2, "box");
    }

    #[test]
    fn only_similarities_keep_a_sphere_a_sphere() {
        let sphere = sphere();
        let mirrored = Affine3A::from_scale(Vec3::new(3.0, 3.0, -3.0));
        let moved = sphere.transformed(&mirrored).expect("a sphere");
        assert!((moved.radius() - 6.0).abs() < 1e-5, "three times as large");
        assert_eq!(moved.center(), Vec3::new(15.0, 0.0, 3.0), "mirrored");
        let squeezed = Affine3A::from_scale(Vec3::new(1.0, 1.01, 1.0));
        let flat = Affine3A::from_scale(Vec3::ZERO);
        let nowhere = Affine3A::from_translation(Vec3::NAN);
        for bad in [squeezed, flat, nowhere] {
            assert_eq!(sphere.transformed(&bad), None, "{bad}");
        }
    }

    #[test]
    fn its_triangles_have_its_front() {
        for (front, sign) in [(SphereFront::Outside, 1.0), (SphereFront::Inside, -1.0)] {
            let mesh = Sphere { front, ..sphere() }.mesh(16);
            let volumes = (0..mesh.indices.len()).map(|index| {
                let [a, b, c] = mesh.triangle(index);
                (b - a).cross(c - a).dot(a - sphere().center()) / 6.0
            });
            let volume = sign * volumes.sum::<f32>();
            let exact = 4.0 / 3.0 * PI * 8.0;
            assert!((volume / exact - 1.0).abs() < 0.1, "{front:?}: {volume}");
        }
    }
}
