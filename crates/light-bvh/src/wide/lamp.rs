use light_bounds::LightBounds;
use light_math::glam::Vec3;

use super::moments::Moments;

/// A light as far as the builder looks at it to find its neighbours.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamp {
    pub(super) center: Vec3,
    /// As a share of the power of all lights.
    pub(super) power: f32,
    /// Axis of its moments: the narrower a cone, the longer.
    pub(super) axis: Vec3,
    pub(super) light: u32,
}

impl Lamp {
    #[inline]
    pub(super) fn new(light: u32, bounds: &LightBounds, power: f32) -> Self {
        Self {
            center: bounds.bounds.center(),
            power,
            axis: Moments::of_light(bounds, 1.0).axis,
            light,
        }
    }
}
