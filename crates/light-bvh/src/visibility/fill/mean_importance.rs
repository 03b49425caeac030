//! The mean importance of the children of copied nodes, over the places of a cell.

use alloc::vec;
use alloc::vec::Vec;
use core::borrow::Borrow;

use light_bounds::LightSampleContext;
use light_math::float::positive_product;

use crate::importance::receiver::Receiver;
use crate::node::wide_node::WIDTH;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::into_receiver::{IntoReceiver, Query, QueryFor};
use crate::simd::dispatch;

/// The largest importance: sums of all children of all copied nodes stay floats.
const MAX_IMPORTANCE: f32 = 1e30;

/// The mean importance of each child of the nodes of these indices, in a unit that all share.
pub(super) fn mean_importance<P: Borrow<LightSampleContext>>(
    tree: &LightBvhRef<'_>,
    nodes: &[u32],
    places: &[P],
) -> Vec<[f32; WIDTH]> {
    let mut sums = vec![[0.0; WIDTH]; nodes.len()];
    let share = 1.0 / places.len().max(1) as f32;
    for place in places.iter().map(Borrow::borrow) {
        let add = Add {
            tree: &tree.wanting(place.groups),
            nodes,
            share,
            sums: &mut sums,
        };
        dispatch(QueryFor(&place.keep(), add));
    }
    sums
}

/// Adds the importance of one place.
struct Add<'a, 'b> {
    tree: &'b LightBvhRef<'a>,
    nodes: &'b [u32],
    share: f32,
    sums: &'b mut [[f32; WIDTH]],
}

impl Query for Add<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) {
        let root = self.tree.nodes().first();
        let unit = root.map_or(1.0, |root| root.inv_scale);
        for (&index, sums) in self.nodes.iter().zip(self.sums) {
            let Some(node) = self.tree.nodes().get(index as usize) else {
                return;
            };
            let weights = self.tree.weights(index as usize, node, receiver);
            let scale = weights.scale_to(unit, node.gain());
            for (sum, weight) in sums.iter_mut().zip(weights.lanes) {
                let importance = positive_product(weight, scale).min(MAX_IMPORTANCE);
                *sum += importance * self.share;
            }
        }
    }
}
