use crate::glam::{Vec2, Vec3};

/// A direction toward a picture of the sky, chosen in proportion to its texels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SkySample {
    /// The point of the picture.
    pub(crate) uv: Vec2,
    /// The colour of the texel there.
    pub(crate) texel: Vec3,
    /// The unit direction in the scene.
    pub(crate) wi: Vec3,
    /// Its density in sr^-1, above 0.
    pub(crate) pdf: f32,
}
