use light_math::glam::Vec3;

use crate::importance::child_view::ChildView;

/// A receiver of light, and the importance of a group of lights to it: the policy of a query to a
/// [`LightBvh`](crate::LightBvh).
///
/// An importance of 0 has to be sound: no light of the group can contribute. Any other value is an
/// estimate.
pub trait Receiver: Copy {
    /// The point that groups are seen from.
    fn position(&self) -> Vec3;

    /// How far from [`position`](Self::position) the receiver reaches: 0 unless it is a segment.
    #[inline]
    fn reach(&self) -> f32 {
        0.0
    }

    /// About four times the group's irradiance, in units of its power over the squared
    /// `1 / inv_unit`.
    ///
    /// `inv_unit` converts lengths to those of the child. To be computed for all children together
    /// it has to be `#[inline]`, without branches.
    fn weigh(&self, child: &ChildView, inv_unit: f32) -> f32;

    /// How likely it is that light of the child reaches the receiver at all, of `[0, 1]`; 1 of a
    /// receiver that does not know.
    #[inline]
    fn likelihood(&self, _child: &ChildView) -> f32 {
        1.0
    }
}

/// No receiver: groups count by the power that their node encodes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NoReceiver;

impl Receiver for NoReceiver {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        // Near no light.
        Vec3::splat(f32::MAX / 8.0)
    }

    #[inline(always)]
    fn weigh(&self, child: &ChildView, _: f32) -> f32 {
        child.power
    }
}
