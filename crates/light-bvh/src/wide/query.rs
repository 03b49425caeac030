use light_bounds::{LightSampleContext, ReceiverSides};
use light_math::glam::Vec3;

use super::glossy::GlossyReceiver;
use super::importance::{MediumReceiver, Receiver, SurfaceReceiver, TwoSidedReceiver, is_far};
use super::segment::SegmentReceiver;

/// A question to a tree that any receiver may ask.
pub(crate) trait Query {
    type Answer;

    /// The answer as `receiver` sees the tree. To be inlined where it is asked: there the vectors are chosen.
    fn of<R: Receiver>(self, receiver: &R) -> Self::Answer;
}

/// Who turns into a receiver to ask a [`Query`].
pub(crate) trait Asker {
    fn ask<Q: Query>(self, query: Q) -> Q::Answer;
}

/// A receiver asks as it is.
pub(crate) struct Oneself<'a, R>(pub(crate) &'a R);

impl<R: Receiver> Asker for Oneself<'_, R> {
    #[inline(always)]
    fn ask<Q: Query>(self, query: Q) -> Q::Answer {
        query.of(self.0)
    }
}

/// A context asks as the receiver that it stands for: a ray segment, a point in a medium, or a point on a surface by its shading normal.
impl Asker for &LightSampleContext {
    #[inline(always)]
    fn ask<Q: Query>(self, query: Q) -> Q::Answer {
        if self.segment != Vec3::ZERO {
            return query.of(&SegmentReceiver::new(self.p, self.segment));
        }
        // Where coordinates had to be clamped, directions to lights mean nothing.
        let normal = self.unit_ns().filter(|_| !is_far(self.p));
        let Some(ns) = normal else {
            return query.of(&MediumReceiver::new(self.p));
        };
        match (self.sides, &self.gloss) {
            (ReceiverSides::Front, None) => query.of(&SurfaceReceiver::facing(self.p, ns)),
            (ReceiverSides::Front, Some(gloss)) => {
                query.of(&GlossyReceiver::facing(self.p, ns, gloss))
            }
            (ReceiverSides::Both, _) => query.of(&TwoSidedReceiver::facing(self.p, ns)),
        }
    }
}
