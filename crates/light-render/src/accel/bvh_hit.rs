use lights::glam::Vec2;

/// Where a ray meets the primitives of one hierarchy first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BvhHit {
    /// Which primitive.
    pub(super) number: u32,
    /// Distance along the ray.
    pub(super) t: f32,
    /// Where on it, as [`Hit::place`](super::Hit::place) has it.
    pub(super) place: Vec2,
}
