use light_bounds::{LightGroups, LightId};

use crate::importance::context_receiver::ContextReceiver;
use crate::importance::receiver::NoReceiver;
use crate::instances::placed_frame::PlacedFrame;
use crate::instances::prototype::LightPrototype;
use crate::query::ascent::Ascent;
use crate::query::into_receiver::{KeptReceiver, Query, QueryFor};
use crate::simd::{VectorWork, dispatch};

/// A part of a placement, which a receiver looks into.
pub(crate) struct PlacedPart<'a> {
    pub(crate) frame: &'a PlacedFrame,
    pub(crate) prototype: &'a LightPrototype,
    /// Whether the receiver may get other shares of the powers of its lights.
    pub(crate) is_told_apart: bool,
}

impl PlacedPart<'_> {
    /// Probability of a light of the part.
    #[inline(always)]
    pub(crate) fn pmf(
        &self,
        light: LightId,
        receiver: &ContextReceiver,
        groups: LightGroups,
    ) -> f32 {
        let tree = &self.prototype.view().wanting(groups);
        self.answer(receiver, Ascent { tree, light })
    }

    /// Runs a query of the tree of the prototype.
    #[inline(always)]
    pub(crate) fn answer<Q: Query>(&self, receiver: &ContextReceiver, query: Q) -> Q::Output {
        if self.is_told_apart {
            let part = self;
            dispatch(InFrame {
                part,
                receiver,
                query,
            })
        } else {
            dispatch(QueryFor(&NoReceiver, query))
        }
    }
}

/// A query of the tree of a placed prototype: the receiver is moved into its frame in the same
/// function, where it stays in registers.
struct InFrame<'a, Q> {
    part: &'a PlacedPart<'a>,
    receiver: &'a ContextReceiver,
    query: Q,
}

impl<Q: Query> VectorWork for InFrame<'_, Q> {
    type Output = Q::Output;

    #[inline(always)]
    fn run(self) -> Q::Output {
        let PlacedPart {
            frame, prototype, ..
        } = self.part;
        frame.receiver(self.receiver, prototype).run(self.query)
    }
}
