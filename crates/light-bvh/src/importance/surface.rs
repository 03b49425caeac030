use light_math::direction;
use light_math::glam::Vec3;

use crate::importance::child_view::ChildView;
use crate::importance::horizon::{Horizon, expected_abs};
use crate::importance::position::near;
use crate::importance::receiver::Receiver;
use crate::lane_math::{larger, masked};

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
    #[inline(always)]
    pub(crate) fn facing(p: Vec3, n: Vec3) -> Self {
        Self {
            p: near(p),
            horizon: Horizon::new(n),
        }
    }

    /// About twice the mean height of the child's lights above the horizon, those below counting as
    /// 0.
    #[inline(always)]
    pub(crate) fn expected_height(&self, child: &ChildView) -> f32 {
        let (height, support) = self.horizon.height(child);
        larger(child.slack, height + expected_abs(height, support))
    }
}

impl Receiver for SurfaceReceiver {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[inline(always)]
    fn weigh(&self, child: &ChildView, _: f32) -> f32 {
        let (height, support) = self.horizon.height(child);
        let lit = (height + support > -child.slack) & child.may_reach();
        let lift = self.horizon.lift(child, height, support);
        masked(child.weight(self.expected_height(child), lift), lit)
    }
}
