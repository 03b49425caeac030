use crate::glam::{Vec2, Vec3};

/// A point on a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfacePoint {
    /// The point, in scene units.
    pub p: Vec3,
    /// Unit geometric normal of the front side, whichever side emits.
    pub n: Vec3,
    /// Surface parameters in `[0, 1]^2`.
    pub uv: Vec2,
}
