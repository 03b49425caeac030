use light_scene::SphereFront;
use lights::glam::{Vec2, Vec3};
use lights::math::octahedral;
use lights::sources::SurfacePoint;
use lights::sources::shape::{AnyShape, Sphere};

use crate::WorldError;

/// A sphere of one material.
#[derive(Debug, serde::Serialize)]
pub(crate) struct WorldSphere {
    pub(crate) described: light_scene::Sphere,
    /// It follows from the description.
    #[serde(skip)]
    pub(crate) shape: Sphere,
}

impl WorldSphere {
    pub(crate) fn material(&self) -> usize {
        self.described.material.0 as usize
    }

    /// The point whose outward normal has the octahedral coordinates `coords`, with that normal.
    #[inline]
    pub(super) fn at(&self, coords: Vec2) -> SurfacePoint {
        self.shape.at(octahedral::from_square(coords))
    }

    /// The normal of the front, where that of the outside is `n`.
    #[inline]
    pub(super) fn front_normal(&self, n: Vec3) -> Vec3 {
        match self.described.front {
            SphereFront::Outside => n,
            SphereFront::Inside => -n,
        }
    }
}

impl TryFrom<light_scene::Sphere> for WorldSphere {
    type Error = WorldError;

    fn try_from(described: light_scene::Sphere) -> Result<Self, WorldError> {
        match described.shape().build() {
            Ok(AnyShape::Sphere(shape)) => Ok(Self { described, shape }),
            _ => Err(WorldError::Sphere {
                name: described.name,
            }),
        }
    }
}
