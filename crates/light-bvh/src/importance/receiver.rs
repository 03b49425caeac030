use light_math::glam::Vec3;

use crate::importance::child_view::ChildView;

/// A receiver of light, and the importance of a group of lights to it: the policy of a query to a
/// [`LightBvh`](crate::LightBvh).
///
/// An importance of 0 has to be sound: no light of the group can contribute. Any other value is an
/// estimate. A receiver of your own is one of this crate's times a factor of what it knows of
/// directions and places; how a group emits is known to these alone.
///
/// ```
/// use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
/// use light_bvh::light_bounds::{LightBounds, LightExtent, LightId};
/// use light_bvh::{ChildView, LightBvh, Receiver, SurfaceReceiver};
///
/// /// A table behind a curtain in the plane of y and z, which takes nine tenths of the light from
/// /// beyond it.
/// #[derive(Clone, Copy)]
/// struct Curtained(SurfaceReceiver);
///
/// impl Receiver for Curtained {
///     fn position(&self) -> Vec3 {
///         self.0.position()
///     }
///
///     fn weigh(&self, child: &ChildView, inv_unit: f32) -> f32 {
///         let x = self.position().x * inv_unit + child.mean[0];
///         let passes = if x > 0.0 { 0.1 } else { 1.0 };
///         passes * self.0.weigh(child, inv_unit)
///     }
///
///     fn likelihood(&self, child: &ChildView) -> f32 {
///         self.0.likelihood(child)
///     }
/// }
///
/// let lamp = |x: f32| LightExtent::Bounded(LightBounds {
///     bounds: Aabb::from_point(Vec3::new(x, 0.0, 2.0)),
///     w: Vec3::NEG_Z,
///     phi: 1.0,
///     cos_theta_o: 1.0,
///     cos_theta_e: 0.0,
///     two_sided: false,
/// });
/// let tree = LightBvh::build(&[lamp(-2.0), lamp(1.0)])?;
/// let table = SurfaceReceiver::new(Vec3::X * -0.5, Vec3::Z);
/// let beyond = LightId(1);
/// assert!((tree.view().pmf(&table, beyond) - 0.5).abs() < 0.01);
/// assert!(tree.view().pmf(&Curtained(table), beyond) < 0.1);
/// # Ok::<(), light_bvh::LightBvhError>(())
/// ```
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
