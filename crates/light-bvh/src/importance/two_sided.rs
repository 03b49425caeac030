use light_math::direction;
use light_math::glam::Vec3;

use crate::importance::child_view::ChildView;
#[cfg(feature = "alloc")]
use crate::importance::frame::Frame;
use crate::importance::horizon::Horizon;
use crate::importance::position::near;
use crate::importance::receiver::Receiver;

/// A point on a surface that light reaches from both sides.
#[derive(Clone, Copy, Debug)]
pub struct TwoSidedReceiver {
    p: Vec3,
    horizon: Horizon,
}

impl TwoSidedReceiver {
    /// The point `p` with the normal `n`, of any length.
    #[inline(always)]
    #[must_use]
    pub fn new(p: Vec3, n: Vec3) -> Self {
        Self::facing(p, direction(n).unwrap_or(Vec3::ZERO))
    }

    /// The point `p` with the unit normal `n`.
    #[inline(always)]
    pub(crate) fn facing(p: Vec3, n: Vec3) -> Self {
        Self {
            p: near(p),
            horizon: Horizon::new(n),
        }
    }

    /// The same point in another frame.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn in_frame(&self, frame: &Frame) -> Self {
        let n = frame.direction(self.horizon.normal());
        Self::facing(frame.point(self.p), n)
    }
}

impl Receiver for TwoSidedReceiver {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[cfg_attr(target_os = "none", inline)]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    fn weigh(&self, child: &ChildView, _: f32) -> f32 {
        let half = self.horizon.half_height(child).either_side(child.slack);
        let weight = child.weight(&child.displacement(), 2.0 * half, 0.0);
        child.may_reach().keep(weight)
    }

    fn likelihood(&self, child: &ChildView) -> f32 {
        child.likelihood()
    }
}
