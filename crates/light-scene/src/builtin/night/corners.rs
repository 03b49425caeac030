use crate::glam::Vec2;

/// The corners of a rectangle for `Modeller::panel`.
pub(super) fn corners(x: [f32; 2], y: [f32; 2]) -> [Vec2; 2] {
    [Vec2::new(x[0], y[0]), Vec2::new(x[1], y[1])]
}
