use light_math::float;
use light_math::glam::Vec3;

use crate::importance::child_view::ChildView;
use crate::lane_math::larger;

/// How much of the squared support of a child counts as variance of its height over the horizon.
/// Chosen by V: see `docs/light-bvh.md`.
const HEIGHT: f32 = 0.2;

/// The plane through a receiver, with its normal up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Horizon {
    n: Vec3,
    /// Half of the normal, and its absolute value: what every child is multiplied by.
    half_n: Vec3,
    abs_half_n: Vec3,
}

impl Horizon {
    #[inline(always)]
    pub(crate) fn new(n: Vec3) -> Self {
        let half_n = 0.5 * n;
        Self {
            n,
            half_n,
            abs_half_n: half_n.abs(),
        }
    }

    /// Half of the mean height over the plane, and half of that by which the highest point of the
    /// box may exceed it. Halved, so that a later sum `root + x` needs no factor 1/2.
    #[inline(always)]
    pub(crate) fn half_height(&self, child: &ChildView) -> (f32, f32) {
        let (n, abs_n) = (self.half_n, self.abs_half_n);
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
    /// Lights that fill their box evenly, from `mean - support` to `mean + support`, have that mean
    /// at `(mean + support) / 2` where the box straddles the horizon: it is raised by half of
    /// `support - mean`, of which the arguments are half. Of lights that face down, those above the
    /// horizon are those in front.
    #[inline(always)]
    pub(crate) fn lift(&self, child: &ChildView, height: f32, support: f32) -> f32 {
        let [mx, my, mz] = child.axis;
        let n = self.n;
        let raised = child.is_ramp_group().keep(larger(0.0, support - height));
        raised * (mx * n.x + my * n.y + mz * n.z)
    }
}

/// About half of the mean distance from the horizon, up or down, of lights of half the given height
/// and support: more than `-height` even where the support just reaches the horizon.
#[inline(always)]
pub(crate) fn half_expected_abs(height: f32, support: f32) -> f32 {
    float::sqrt(height * height + HEIGHT * (support * support))
}
