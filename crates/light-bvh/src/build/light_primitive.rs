use light_bounds::LightBounds;
use light_math::glam::Vec3;

use crate::node::moments::Moments;

/// How long the builder takes the axes of narrow cones to be: where they point matters more than how narrow they are.
const LONGEST_AXIS: f32 = 3.0;

/// Squared length of an axis beyond which a cone is narrow; that of a diffuse light is at most 1.
pub(crate) const NARROW: f32 = 8.4;

/// A light as far as the builder looks at it to find its neighbours.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightPrimitive {
    pub(crate) center: Vec3,
    /// As a share of the power of all lights.
    pub(crate) power: f32,
    pub(crate) light: u32,
    /// Axis of its moments, as far as the builder looks at it.
    pub(crate) axis: Vec3,
}

impl LightPrimitive {
    #[inline]
    pub(crate) fn new(light: u32, bounds: &LightBounds, power: f32) -> Self {
        let LightBounds {
            cos_theta_o,
            cos_theta_e,
            two_sided,
            ..
        } = *bounds;
        let length = Moments::axis_length(cos_theta_o, cos_theta_e, two_sided);
        Self {
            center: bounds.bounds.center(),
            power,
            light,
            axis: bounds.w * length.min(LONGEST_AXIS),
        }
    }
}
