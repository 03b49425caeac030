use lights::math::Aabb;

use crate::glam::{Affine3A, Vec3};
use crate::{Mesh, PrototypeId, Sphere};

/// Meshes and spheres that stand in several places, stored once: a tree of a forest. In itself it
/// stands nowhere.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Prototype {
    /// The name in the file; may be empty.
    pub name: String,
    /// What it consists of, in coordinates of its own.
    pub meshes: Vec<Mesh>,
    /// The spheres in it; a place may stretch them.
    pub spheres: Vec<Sphere>,
}

/// A place where a prototype stands.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Placement {
    /// What stands there.
    pub prototype: PrototypeId,
    /// From its coordinates to those of the scene; what was in front of a triangle stays in front,
    /// mirrored or not.
    pub place: Affine3A,
}

impl Prototype {
    /// These meshes under a name.
    #[must_use]
    pub fn new(name: impl Into<String>, meshes: Vec<Mesh>) -> Self {
        Self {
            name: name.into(),
            meshes,
            spheres: Vec::new(),
        }
    }

    /// The number of its triangles, each stored once.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.indices.len()).sum()
    }

    /// The boxes around its meshes and spheres.
    pub(crate) fn boxes(&self) -> Vec<Aabb> {
        let meshes = self.meshes.iter().map(Mesh::bounds);
        meshes
            .chain(self.spheres.iter().map(Sphere::bounds))
            .collect()
    }
}

impl Placement {
    /// A box around `boxes` where the placement puts them.
    pub(crate) fn bounds(&self, boxes: &[Aabb]) -> Aabb {
        Aabb::from_points(self.corners(boxes))
    }

    /// Whether all that lies in `boxes` has finite coordinates where the placement puts it.
    pub(crate) fn is_finite(&self, boxes: &[Aabb]) -> bool {
        self.corners(boxes).all(|corner| corner.is_finite())
    }

    /// The corners of `boxes` where the placement puts them.
    fn corners(&self, boxes: &[Aabb]) -> impl Iterator<Item = Vec3> {
        let boxes = boxes.iter().filter(|bounds| !bounds.is_empty());
        let corners = boxes.flat_map(corners);
        corners.map(|corner| self.place.transform_point3(corner))
    }
}

/// The corners of a box that is not empty.
fn corners(bounds: &Aabb) -> impl Iterator<Item = Vec3> {
    let Aabb { min, max } = *bounds;
    (0..8u32).map(move |corner| {
        let pick = |axis: u32, low, high| if corner >> axis & 1 == 0 { low } else { high };
        Vec3::new(
            pick(0, min.x, max.x),
            pick(1, min.y, max.y),
            pick(2, min.z, max.z),
        )
    })
}
