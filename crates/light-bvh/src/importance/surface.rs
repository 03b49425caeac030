use light_math::direction;
use light_math::glam::Vec3;

use crate::importance::child_view::ChildView;
#[cfg(feature = "alloc")]
use crate::importance::frame::Frame;
use crate::importance::horizon::Horizon;
use crate::importance::position::near;
use crate::importance::receiver::Receiver;

/// A point on a surface that light reaches from the side of its normal only.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceReceiver {
    p: Vec3,
    horizon: Horizon,
}

impl SurfaceReceiver {
    /// The point `p` with the normal `n`, of any length; one without a direction has no horizon.
    #[inline(always)]
    #[must_use]
    pub fn new(p: Vec3, n: Vec3) -> Self {
        Self::facing(p, direction(n).unwrap_or(Vec3::ZERO))
    }

    /// The point `p` with the unit normal `n`.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
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

    /// About the mean height of the child's lights above the horizon, those below counting as
    /// 0.
    #[inline(always)]
    pub(crate) fn expected_height(&self, child: &ChildView) -> f32 {
        self.horizon.half_height(child).above(child.slack)
    }

    /// Whether the child's lights give other shares of their powers.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn tells_apart(&self, child: &ChildView) -> bool {
        !(child.is_uniform() && self.horizon.half_height(child).is_uniform())
    }
}

impl Receiver for SurfaceReceiver {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[cfg_attr(target_os = "none", inline)]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    fn weigh(&self, child: &ChildView, _: f32) -> f32 {
        let height = self.horizon.half_height(child);
        let (from, lift) = match &child.sheet {
            None => (child.displacement(), self.horizon.lift(child, &height)),
            Some(sheet) => self.horizon.above(child, &height, sheet),
        };
        let weight = child.weight(&from, height.above(child.slack), lift);
        let is_above = height.is_above(child.slack);
        is_above.and(child.may_reach()).keep(weight)
    }

    #[cfg_attr(soft_floats, inline(never))]
    fn likelihood(&self, child: &ChildView) -> f32 {
        child.likelihood() * self.horizon.half_height(child).likelihood()
    }
}
