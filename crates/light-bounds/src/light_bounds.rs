use crate::glam::Vec3;
use light_math::Aabb;

/// Bounds of where a light (or a group of lights) is, where it emits, and how much.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LightBounds {
    /// Box around all emitting points.
    pub bounds: Aabb,
    /// Unit axis of the cone that holds the emitters' normals.
    pub w: Vec3,
    /// Emitted power in W, or any common multiple of it; for spot lights as if they shone in all directions.
    pub phi: f32,
    /// Cosine of the half angle of the cone of normals.
    pub cos_theta_o: f32,
    /// Cosine of the angle beyond that cone up to which light is emitted.
    pub cos_theta_e: f32,
    /// Whether light is emitted on both sides.
    pub two_sided: bool,
}
