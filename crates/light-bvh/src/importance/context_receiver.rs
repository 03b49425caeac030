use light_bounds::{LightSampleContext, ReceiverKind, ReceiverSides};
use light_math::glam::Vec3;

use crate::importance::child_view::ChildView;
#[cfg(feature = "alloc")]
use crate::importance::frame::Frame;
use crate::importance::glossy::GlossyReceiver;
use crate::importance::medium::MediumReceiver;
use crate::importance::position::is_far;
use crate::importance::receiver::Receiver;
use crate::importance::segment::SegmentReceiver;
use crate::importance::surface::SurfaceReceiver;
use crate::importance::two_sided::TwoSidedReceiver;

/// The receiver that a [`LightSampleContext`] stands for.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum ContextReceiver {
    /// A point on a surface.
    Surface(SurfaceReceiver),
    /// A point on a surface that mirrors.
    Glossy(GlossyReceiver),
    /// A point on a surface that transmits.
    TwoSided(TwoSidedReceiver),
    /// A point in a medium.
    Medium(MediumReceiver),
    /// A ray segment in a medium.
    Segment(SegmentReceiver),
}

impl From<&LightSampleContext> for ContextReceiver {
    #[inline(always)]
    fn from(ctx: &LightSampleContext) -> Self {
        let p = ctx.p;
        match *ctx.kind() {
            ReceiverKind::Segment { extent, .. } => Self::Segment(SegmentReceiver::new(p, extent)),
            // Where coordinates were clamped, directions to lights mean nothing.
            ReceiverKind::Surface {
                ns, sides, gloss, ..
            } if !is_far(p) => match (sides, &gloss) {
                (ReceiverSides::Front, None) => Self::Surface(SurfaceReceiver::facing(p, ns)),
                (ReceiverSides::Front, Some(gloss)) => {
                    Self::Glossy(GlossyReceiver::facing(p, ns, gloss))
                }
                (ReceiverSides::Both, _) => Self::TwoSided(TwoSidedReceiver::facing(p, ns)),
            },
            _ => Self::Medium(MediumReceiver::new(p)),
        }
    }
}

/// `$run` with the receiver that a [`ContextReceiver`] holds, compiled for each kind.
macro_rules! with_kind {
    ($context:expr, $receiver:ident => $run:expr) => {
        match $context {
            ContextReceiver::Surface($receiver) => $run,
            ContextReceiver::Glossy($receiver) => $run,
            ContextReceiver::TwoSided($receiver) => $run,
            ContextReceiver::Medium($receiver) => $run,
            ContextReceiver::Segment($receiver) => $run,
        }
    };
}
pub(crate) use with_kind;

impl ContextReceiver {
    /// The point that groups are seen from.
    #[inline(always)]
    pub(crate) fn position(&self) -> Vec3 {
        with_kind!(self, receiver => receiver.position())
    }

    /// Whether the lights of a child may give it other shares of their powers: `false` where all are
    /// in about the same direction and at about the same distance.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn tells_apart(&self, child: &ChildView) -> bool {
        match self {
            Self::Surface(surface) => surface.tells_apart(child),
            Self::Medium(_) => !child.is_uniform(),
            Self::Glossy(_) | Self::TwoSided(_) | Self::Segment(_) => true,
        }
    }

    /// The same receiver in another frame.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn in_frame(&self, frame: &Frame) -> Self {
        let p = frame.point(self.position());
        match self {
            Self::Segment(segment) => Self::Segment(segment.in_frame(frame)),
            // Where coordinates are clamped, directions to lights mean nothing.
            _ if is_far(p) => Self::Medium(MediumReceiver::new(p)),
            Self::Surface(surface) => Self::Surface(surface.in_frame(frame)),
            Self::Glossy(glossy) => Self::Glossy(glossy.in_frame(frame)),
            Self::TwoSided(two_sided) => Self::TwoSided(two_sided.in_frame(frame)),
            Self::Medium(medium) => Self::Medium(medium.in_frame(frame)),
        }
    }
}

/// The receiver that a [`ContextReceiver`] holds, as one type that looks at each child which kind
/// it is: a third of the code of a query that is compiled for each kind, and slower.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AnyKind<'a>(pub(crate) &'a ContextReceiver);

impl Receiver for AnyKind<'_> {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.0.position()
    }

    #[inline(never)]
    fn reach(&self) -> f32 {
        with_kind!(self.0, receiver => receiver.reach())
    }

    #[inline(never)]
    fn weigh(&self, child: &ChildView, inv_unit: f32) -> f32 {
        with_kind!(self.0, receiver => receiver.weigh(child, inv_unit))
    }

    fn likelihood(&self, child: &ChildView) -> f32 {
        with_kind!(self.0, receiver => receiver.likelihood(child))
    }
}
