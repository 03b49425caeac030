use light_math::glam::Vec3;

use crate::importance::child_view::ChildView;

/// Who asks a [`LightBvh`](crate::LightBvh), and what a group of lights is worth to it.
///
/// A policy may return 0 only when no light of the group can contribute: that test has to be sound. Everything else is an estimate.
pub trait Receiver: Copy {
    /// The point that groups are seen from.
    fn position(&self) -> Vec3;

    /// How far from [`position`](Self::position) the receiver reaches: 0 unless it is a segment.
    #[inline]
    fn reach(&self) -> f32 {
        0.0
    }

    /// About four times the group's irradiance, in units of its power over the squared `1 / inv_unit`.
    ///
    /// `inv_unit` converts lengths to those of the child. To be computed for all children together it has to be `#[inline]`, without
    /// branches.
    fn weigh(&self, child: &ChildView, inv_unit: f32) -> f32;
}

/// Nobody in particular: groups count by their peak intensity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NoReceiver;

impl Receiver for NoReceiver {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        Vec3::ZERO
    }

    #[inline(always)]
    fn weigh(&self, child: &ChildView, _: f32) -> f32 {
        child.power
    }
}
