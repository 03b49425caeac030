use light_math::float;
use light_math::glam::Vec3;

use crate::importance::child_view::ChildView;
use crate::lane_math::larger;

/// How much of the squared support of a child counts as variance of its height over the horizon.
/// Chosen by V: see `docs/light-bvh.md`.
const HEIGHT: f32 = 0.35;

/// How much of the support is taken off the expected height again, for no light is beyond it.
/// Chosen by V.
const BEYOND: f32 = 0.14;

/// The plane through a receiver, with its normal up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Horizon {
    n: Vec3,
    abs_n: Vec3,
}

impl Horizon {
    #[inline(always)]
    pub(crate) fn new(n: Vec3) -> Self {
        Self { n, abs_n: n.abs() }
    }

    /// Mean height over the plane, and by how much the highest point of the box may exceed it.
    #[inline(always)]
    pub(crate) fn height(&self, child: &ChildView) -> (f32, f32) {
        let Self { n, abs_n } = self;
        let [vx, vy, vz] = child.mean;
        let [hx, hy, hz] = child.extent;
        (
            n.x * vx + n.y * vy + n.z * vz,
            abs_n.x * hx + abs_n.y * hy + abs_n.z * hz,
        )
    }

    /// How much the product of the axis of a group and its mean position changes where only what is
    /// above the horizon counts; 0 of what is no group of ramps.
    ///
    /// Lights that fill their box evenly have that mean half way between the highest point and the
    /// larger of their mean height and zero: it is raised by half of `support - height`. Height and
    /// emission so go together: where lights face down, what is above the horizon is what is in
    /// front.
    #[inline(always)]
    pub(crate) fn lift(&self, child: &ChildView, height: f32, support: f32) -> f32 {
        let [mx, my, mz] = child.axis;
        let n = self.n;
        let raised = child.is_ramp_group().keep(larger(0.0, support - height));
        (0.5 * raised) * (mx * n.x + my * n.y + mz * n.z)
    }
}

/// About the mean distance from the horizon, up or down, of lights whose height varies as `support`
/// allows: more than `-height` even where the support just reaches the horizon.
#[inline(always)]
pub(crate) fn expected_abs(height: f32, support: f32) -> f32 {
    float::sqrt(height * height + HEIGHT * (support * support)) - BEYOND * support
}
