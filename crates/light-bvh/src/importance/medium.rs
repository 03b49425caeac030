use light_math::glam::Vec3;

use crate::importance::child_view::ChildView;
#[cfg(feature = "alloc")]
use crate::importance::frame::Frame;
use crate::importance::position::near;
use crate::importance::receiver::Receiver;

/// A point in a medium, where light counts from all directions alike.
#[derive(Clone, Copy, Debug)]
pub struct MediumReceiver {
    p: Vec3,
}

impl MediumReceiver {
    /// The origin.
    pub(crate) const ORIGIN: Self = Self { p: Vec3::ZERO };

    /// The point `p`.
    #[inline(always)]
    #[must_use]
    pub fn new(p: Vec3) -> Self {
        Self { p: near(p) }
    }

    /// The same point in another frame.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn in_frame(&self, frame: &Frame) -> Self {
        Self::new(frame.point(self.p))
    }
}

impl Receiver for MediumReceiver {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[cfg_attr(target_os = "none", inline)]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    fn weigh(&self, child: &ChildView, _: f32) -> f32 {
        child.fluence(&child.displacement())
    }

    fn likelihood(&self, child: &ChildView) -> f32 {
        child.likelihood()
    }
}
