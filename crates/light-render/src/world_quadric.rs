use light_scene::{Quadric, QuadricFront};
use lights::glam::{Vec2, Vec3};
use lights::sources::SurfacePoint;

use crate::{QuadricShape, WorldError};

/// A sphere, disk or cylinder of one material, whole or in part.
#[derive(Debug, serde::Serialize)]
pub(crate) struct WorldQuadric {
    pub(crate) described: Quadric,
    /// That of the whole; it follows from the description.
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
        let at = self.shape.at(coords);
        let uv = self.described.part.map_or(at.uv, |part| part.uv(at.uv));
        SurfacePoint { uv, ..at }
    }

    /// Whether the point with these coordinates belongs to the part that is there.
    #[inline]
    pub(super) fn is_there(&self, coords: Vec2) -> bool {
        let part = self.described.part;
        part.is_none_or(|part| part.contains(self.shape.at(coords).uv))
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
