//! Which subtrees a receiver is at the edge of, near, or beside.

use light_math::glam::Vec3;

use crate::importance::child_view::{ChildView, NodeFrame};
use crate::node::child_codes::READS_WORDS;
use crate::node::wide_node::{WIDTH, WideNode};
use crate::query::weights::Weights;
use crate::simd::VectorWork;

/// The children whose weight may be off by more than `DOUBT`, a bit each, and above these those that
/// the receiver is [beside](ChildView::beside).
pub(crate) struct Doubtful<'a> {
    pub(crate) node: &'a WideNode,
    pub(crate) position: Vec3,
    pub(crate) weights: &'a Weights,
}

impl VectorWork for Doubtful<'_> {
    type Output = u32;

    #[inline(always)]
    fn run(self) -> u32 {
        self.bits()
    }
}

impl Doubtful<'_> {
    // Without an operating system the stack is short: what this has there is free again before a
    // subtree is looked into.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    fn bits(&self) -> u32 {
        let frame = NodeFrame::in_codes(self.node, self.position);
        let rare = self.node.has_rare();
        let inv_total = 1.0 / self.weights.total;
        let mut bits = 0;
        if READS_WORDS {
            for quarter in 0..WIDTH / 4 {
                let four = self.node.four_children(quarter);
                for j in 0..4 {
                    let k = 4 * quarter + j;
                    let child = frame.child(&four.child_codes(j), rare);
                    bits |= self.bit(&child, k, inv_total);
                }
            }
        } else {
            for k in 0..WIDTH {
                bits |= self.bit(&frame.child_at(self.node, k, rare), k, inv_total);
            }
        }
        bits
    }

    #[inline(always)]
    fn bit(&self, child: &ChildView, k: usize, inv_total: f32) -> u32 {
        let doubt = child.doubt(self.weights.lanes[k] * inv_total);
        u32::from(doubt > 0.0) << k | u32::from(child.beside() > 0.0) << (WIDTH + k)
    }
}
