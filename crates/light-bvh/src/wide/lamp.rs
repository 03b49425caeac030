use light_bounds::LightBounds;
use light_math::glam::Vec3;

use super::moments::Moments;

/// How long the builder takes the axes of narrow cones to be: where they point matters more than how narrow they are.
const LONGEST_AXIS: f32 = 3.0;

/// Squared length of an axis beyond which a cone is narrow; that of a diffuse light is at most 1.
pub(super) const NARROW: f32 = 8.4;

/// A light as far as the builder looks at it to find its neighbours.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamp {
    pub(super) center: Vec3,
    /// As a share of the power of all lights.
    pub(super) power: f32,
    pub(super) light: u32,
    w: Vec3,
    cos_theta_o: f32,
    cos_theta_e: f32,
    two_sided: bool,
}

impl Lamp {
    /// Copies, and decides nothing, so that a reader of many lights need not wait for one.
    #[inline]
    pub(super) fn new(light: u32, bounds: &LightBounds, power: f32) -> Self {
        Self {
            center: bounds.bounds.center(),
            power,
            light,
            w: bounds.w,
            cos_theta_o: bounds.cos_theta_o,
            cos_theta_e: bounds.cos_theta_e,
            two_sided: bounds.two_sided,
        }
    }

    /// Axis of its moments, as far as the builder looks at it.
    #[inline]
    pub(super) fn axis(&self) -> Vec3 {
        self.w
            * Moments::axis_length(self.cos_theta_o, self.cos_theta_e, self.two_sided)
                .min(LONGEST_AXIS)
    }
}
