use lights::glam::Vec2;

use crate::PrimitiveId;

/// The first hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The primitive.
    pub primitive: PrimitiveId,
    /// Distance along the ray, in scene units.
    pub t: f32,
    /// Coordinates on the primitive. Triangle: barycentric weights of the second and the third
    /// corner. Quadric: as [`QuadricShape`](crate::QuadricShape) says, in object space.
    pub coords: Vec2,
}
