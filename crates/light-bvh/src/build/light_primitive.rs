use light_bounds::LightBounds;
use light_math::glam::Vec3;

use crate::node::moments::Moments;

/// The longest axis that the builder counts: for narrow cones the direction matters more than the
/// width.
const LONGEST_AXIS: f32 = 3.0;

/// What the builder reads of a light to group it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightPrimitive {
    pub(crate) center: Vec3,
    /// As a share of the power of all lights.
    pub(crate) power: f32,
    pub(crate) light: u32,
    /// Axis of its moments, at most [`LONGEST_AXIS`] long.
    pub(crate) axis: Vec3,
}

impl LightPrimitive {
    #[inline]
    pub(crate) fn new(light: u32, bounds: &LightBounds, power: f32) -> Self {
        let length = Moments::axis_length(bounds);
        Self {
            center: bounds.bounds.center(),
            power,
            light,
            axis: bounds.w * length.min(LONGEST_AXIS),
        }
    }
}
