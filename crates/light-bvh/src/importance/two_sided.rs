use light_math::direction;
use light_math::glam::Vec3;

use crate::importance::child_view::ChildView;
use crate::importance::horizon::{Horizon, expected_abs};
use crate::importance::position::near;
use crate::importance::receiver::Receiver;
use crate::lane_math::{larger, masked};

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
}

impl Receiver for TwoSidedReceiver {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[inline(always)]
    fn weigh(&self, child: &ChildView, _: f32) -> f32 {
        let (height, support) = self.horizon.height(child);
        let expected = larger(child.slack, expected_abs(height, support));
        masked(child.weight(2.0 * expected, 0.0), child.may_reach())
    }
}
