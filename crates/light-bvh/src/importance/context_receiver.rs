use light_bounds::{LightSampleContext, ReceiverKind, ReceiverSides};

use crate::importance::glossy::GlossyReceiver;
use crate::importance::medium::MediumReceiver;
use crate::importance::position::is_far;
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
