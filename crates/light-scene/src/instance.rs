use lights::math::Aabb;

use crate::glam::{Affine3A, Vec3};
use crate::{Mesh, PrototypeId, Quadric};

/// Meshes and quadrics in object space, stored once for any number of [`Instance`]s: a tree of a
/// forest. A prototype without instances is not part of the picture.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Prototype {
    /// The name in the file; may be empty.
    pub name: String,
    /// The meshes in it.
    pub meshes: Vec<Mesh>,
    /// The quadrics in it; the transform of an instance may make ellipsoids of them.
    pub quadrics: Vec<Quadric>,
}

/// A prototype with the transform that puts it into the scene.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Instance {
    /// The prototype.
    pub prototype: PrototypeId,
    /// From object space to world space. The front of a triangle stays its front, even if the
    /// transform mirrors.
    pub transform: Affine3A,
}

impl Prototype {
    /// A prototype of these meshes.
    #[must_use]
    pub fn new(name: impl Into<String>, meshes: Vec<Mesh>) -> Self {
        Self {
            name: name.into(),
            meshes,
            quadrics: Vec::new(),
        }
    }

    /// The number of its triangles, each stored once.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.indices.len()).sum()
    }

    /// The boxes around its meshes and quadrics.
    pub(crate) fn boxes(&self) -> Vec<Aabb> {
        let meshes = self.meshes.iter().map(Mesh::bounds);
        meshes
            .chain(self.quadrics.iter().map(Quadric::bounds))
            .collect()
    }
}

impl Instance {
    /// A world space box around `boxes` of object space.
    pub(crate) fn bounds(&self, boxes: &[Aabb]) -> Aabb {
        Aabb::from_points(self.corners(boxes))
    }

    /// Whether the transformed corners of `boxes` are finite.
    pub(crate) fn is_finite(&self, boxes: &[Aabb]) -> bool {
        self.corners(boxes).all(|corner| corner.is_finite())
    }

    /// The transformed corners of `boxes`.
    fn corners(&self, boxes: &[Aabb]) -> impl Iterator<Item = Vec3> {
        let boxes = boxes.iter().filter(|bounds| !bounds.is_empty());
        let corners = boxes.flat_map(corners);
        corners.map(|corner| self.transform.transform_point3(corner))
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
