use lights::glam::Vec2;

/// Where a ray meets the primitives of one hierarchy first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BvhHit {
    /// Which primitive.
    pub(super) number: u32,
    /// Distance along the ray.
    pub(super) t: f32,
    /// Coordinates on the primitive, as in [`Hit::coords`](super::Hit::coords).
    pub(super) coords: Vec2,
}
