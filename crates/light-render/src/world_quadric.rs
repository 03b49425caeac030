use light_scene::{Quadric, QuadricFront};
use lights::glam::{Vec2, Vec3};
use lights::sources::SurfacePoint;

use crate::{QuadricShape, WorldError};

/// A sphere, disk or cylinder of one material.
#[derive(Debug, serde::Serialize)]
pub(crate) struct WorldQuadric {
    pub(crate) described: Quadric,
    /// It follows from the description.
    #[serde(skip)]
    pub(crate) shape: QuadricShape,
}

impl WorldQuadric {
    pub(crate) fn material(&self) -> usize {
        self.described.material.0 as usize
    }

    /// The point with the coordinates of a [`Hit`](crate::Hit), with its outward normal.
    #[inline]
    pub(super) fn at(&self, coords: Vec2) -> SurfacePoint {
        self.shape.at(coords)
    }

    /// The normal of the front, where that of the outside is `n`.
    #[inline]
    pub(super) fn front_normal(&self, n: Vec3) -> Vec3 {
        match self.described.front {
            QuadricFront::Outside => n,
            QuadricFront::Inside => -n,
        }
    }
}

impl TryFrom<Quadric> for WorldQuadric {
    type Error = WorldError;

    fn try_from(described: Quadric) -> Result<Self, WorldError> {
        let shape = described.shape().build().ok();
        match shape.and_then(QuadricShape::new) {
            Some(shape) => Ok(Self { described, shape }),
            None => Err(WorldError::Quadric {
                name: described.name,
            }),
        }
    }
}
