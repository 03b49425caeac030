use lights::glam::Vec2;

/// The first hit of a ray in one hierarchy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BvhHit {
    /// The number of the primitive.
    pub(super) number: u32,
    /// Distance along the ray.
    pub(super) t: f32,
    /// Coordinates on the primitive, as in [`Hit::coords`](super::Hit::coords).
    pub(super) coords: Vec2,
}
