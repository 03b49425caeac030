use light_math::float;
use light_math::glam::Vec3;

#[cfg(feature = "alloc")]
use crate::importance::child_importance::FAR_SQ;
use crate::importance::child_view::ChildView;
use crate::lane_math::{LaneMask, dot, larger, likely_above_zero};

/// How much of the squared half extents of a child, along the normal, counts as variance of its
/// height over the horizon: a little more than that of lights which fill the box evenly, 1/3.
/// Chosen by V: see `docs/light-bvh-study.md`.
pub(crate) const HEIGHT: f32 = 0.43;

/// The plane through a receiver, with its normal up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Horizon {
    n: Vec3,
    /// Half of the normal, and its absolute value: what every child is multiplied by.
    half_n: Vec3,
    abs_half_n: Vec3,
}

/// The height of a child over a horizon, halved, so that a later sum `root + x` needs no factor
/// 1/2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalfHeight {
    /// Half of the mean.
    mean: f32,
    /// Half of that by which the highest point of the box may exceed the mean.
    support: f32,
    /// A quarter of the variance.
    variance: f32,
}

impl Horizon {
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn new(n: Vec3) -> Self {
        let half_n = 0.5 * n;
        Self {
            n,
            half_n,
            abs_half_n: half_n.abs(),
        }
    }

    /// The normal.
    #[inline(always)]
    pub(crate) const fn normal(&self) -> Vec3 {
        self.n
    }

    /// The height of the child over the plane.
    #[cfg_attr(target_os = "none", inline)]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn half_height(&self, child: &ChildView) -> HalfHeight {
        let (n, abs_n) = (self.half_n, self.abs_half_n);
        let [hx, hy, hz] = child.extent;
        let [sx, sy, sz] = [abs_n.x * hx, abs_n.y * hy, abs_n.z * hz];
        HalfHeight {
            mean: n.dot(Vec3::from(child.mean)),
            support: sx + sy + sz,
            variance: HEIGHT * (sx * sx + sy * sy + sz * sz),
        }
    }

    /// How much the product of the axis of a group and its mean position changes where only what is
    /// above the horizon counts; 0 of what is no group of ramps.
    ///
    /// Lights that fill their box evenly, from `mean - support` to `mean + support`, have that mean
    /// at `(mean + support) / 2` where the box straddles the horizon: it is raised by half of
    /// `support - mean`, of which `height` holds half. Of lights that face down, those above the
    /// horizon are those in front.
    #[inline(always)]
    pub(crate) fn lift(&self, child: &ChildView, height: &HalfHeight) -> f32 {
        let raised = child
            .is_ramp_group()
            .keep(larger(0.0, height.support - height.mean));
        raised * dot(&child.axis, &self.n.to_array())
    }
}

impl HalfHeight {
    /// Whether any point of the box is above the plane, or no more than half of `slack` below it.
    #[inline(always)]
    pub(crate) fn is_above(&self, slack: f32) -> LaneMask {
        LaneMask::when(self.mean + self.support > -slack)
    }

    /// About the mean height of lights, those below counting as 0; at least `slack`. Above 0 even
    /// where the support just reaches the horizon.
    #[cfg_attr(soft_floats, inline(never))]
    #[cfg_attr(not(soft_floats), inline(always))]
    pub(crate) fn above(&self, slack: f32) -> f32 {
        larger(slack, self.mean + self.root())
    }

    /// How likely it is that a light is above the plane.
    #[inline]
    pub(crate) fn likelihood(&self) -> f32 {
        likely_above_zero(self.mean, self.root())
    }

    /// About half of the mean distance of lights from the plane, up or down; at least `slack`.
    #[inline(always)]
    pub(crate) fn either_side(&self, slack: f32) -> f32 {
        larger(slack, self.root())
    }

    /// Whether all lights are above the plane, at about the same height.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn is_uniform(&self) -> bool {
        self.mean > 0.0 && FAR_SQ * self.variance < self.mean * self.mean
    }

    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    fn root(&self) -> f32 {
        float::sqrt(self.mean * self.mean + self.variance)
    }
}
