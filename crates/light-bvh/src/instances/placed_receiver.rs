use light_math::float;
use light_math::glam::Vec3;

use crate::importance::child_view::{ChildView, DISTANCE, ROUND_OFF, dist_sq};
use crate::importance::context_receiver::{AnyKind, ContextReceiver, with_kind};
use crate::importance::receiver::{NoReceiver, Receiver};
use crate::query::into_receiver::{KeptReceiver, Query};

/// A receiver in the frame of a prototype, into which it was moved with round-off.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedReceiver {
    receiver: ContextReceiver,
    /// How far lights may be from where they seem to be; infinite if nothing is known of where
    /// they are.
    error: f32,
}

impl PlacedReceiver {
    /// A receiver whose lights are known to within `error`, and no farther than `reach`.
    #[inline(always)]
    pub(crate) fn new(receiver: ContextReceiver, error: f32, reach: f32) -> Self {
        // Written so that NaN fails.
        let is_known = error <= reach;
        Self {
            receiver,
            error: if is_known { error } else { f32::INFINITY },
        }
    }
}

impl KeptReceiver for PlacedReceiver {
    #[inline(always)]
    fn run<Q: Query>(&self, query: Q) -> Q::Output {
        let error = self.error;
        // Where a whole prototype is within its round-off only powers tell its lights apart.
        if error == f32::INFINITY {
            return query.run(&NoReceiver);
        }
        if cfg!(target_os = "none") {
            let receiver = AnyKind(&self.receiver);
            query.run(&Widened { receiver, error })
        } else {
            with_kind!(self.receiver, receiver => query.run(&Widened { receiver, error }))
        }
    }
}

/// The largest error, in the unit of a node, so that no weight overflows or vanishes. Boxes as
/// large as this hold all receivers near the node, and so do they in a unit near the distance. Of
/// others they make weights in codes so small that these are not trusted.
const WIDEST: f32 = 1e7;

/// A receiver that sees every box larger by an error of positions, so that what it proves of a box
/// it proves of the lights.
#[derive(Clone, Copy, Debug)]
struct Widened<R> {
    receiver: R,
    error: f32,
}

impl<R: Receiver> Receiver for Widened<R> {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.receiver.position()
    }

    #[inline(always)]
    fn reach(&self) -> f32 {
        self.receiver.reach()
    }

    #[inline(always)]
    fn weigh(&self, child: &ChildView, inv_unit: f32) -> f32 {
        let error = (self.error * inv_unit).min(WIDEST);
        let extent = child.extent.map(|half| half + error);
        let dist_sq = dist_sq(child.mean, extent, DISTANCE);
        let dist = float::sqrt(dist_sq);
        let child = ChildView {
            extent,
            dist,
            dist_sq,
            slack: ROUND_OFF * dist,
            ..*child
        };
        self.receiver.weigh(&child, inv_unit)
    }

    fn likelihood(&self, child: &ChildView) -> f32 {
        self.receiver.likelihood(child)
    }
}
