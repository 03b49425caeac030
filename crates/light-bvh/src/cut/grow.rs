//! How a [`LightCut`] is grown.

use light_math::discrete::{PARTS, parts_of, parts_scale};
use light_math::float::positive_product;
use light_math::glam::Vec4;

use crate::cut::light_cut::{CutDetail, CutNodes, LightCut, MAX_NODES};
use crate::importance::receiver::Receiver;
use crate::node::wide_node::WIDTH;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::into_receiver::{IntoReceiver, KeptReceiver, Query, QueryFor};
use crate::query::weights::{MOST, Weights, total};
use crate::simd::dispatch;

/// How many times less or more an opened group may count than it was estimated: a few lights near
/// the receiver, or a beam beside it, would take nearly all of the choices from the other groups.
pub(crate) const MAX_REVISION: f32 = 16.0;

/// How many times less a group may count where lights emit in steps: children at the edges of their
/// beams tell no more than the mean of all. Chosen by V: see `docs/light-bvh-study.md`.
pub(crate) const MAX_STEP_REVISION: f32 = 2.0;

/// How many times the weights of the root such a group may count more. Chosen by V.
pub(crate) const MAX_STEP_RISE: f32 = 4.0;

impl<'a> LightBvhRef<'a> {
    /// A cut through the tree for `receiver`, for several choices there.
    #[must_use]
    pub fn cut<A: IntoReceiver>(&self, receiver: A, detail: CutDetail) -> LightCut<'a, A::Kept> {
        let mut cut = LightCut {
            tree: self.wanting(receiver.groups()),
            receiver: receiver.keep(),
            grown: CutNodes::none(),
        };
        cut.grow(detail);
        cut
    }
}

impl<'a, R: KeptReceiver> LightCut<'a, R> {
    /// Makes this the [cut](LightBvhRef::cut) through `tree` for `receiver`, in place: its 2 KB are
    /// not moved.
    pub fn set<A>(&mut self, tree: &LightBvhRef<'a>, receiver: A, detail: CutDetail)
    where
        A: IntoReceiver<Kept = R>,
    {
        self.tree = tree.wanting(receiver.groups());
        self.receiver = receiver.keep();
        self.grown.clear();
        self.grow(detail);
    }

    #[inline(always)]
    fn grow(&mut self, detail: CutDetail) {
        let grow = Grow {
            tree: &self.tree,
            detail,
            into: &mut self.grown,
        };
        dispatch(QueryFor(&self.receiver, grow));
    }
}

/// [`LightBvhRef::cut`].
struct Grow<'a, 'b> {
    tree: &'b LightBvhRef<'a>,
    detail: CutDetail,
    into: &'b mut CutNodes,
}

impl Query for Grow<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) {
        let Self {
            tree,
            detail,
            into: cut,
        } = self;
        let mut count = usize::from(!tree.is_empty());
        let (mut root_total, mut limit) = (0.0, 0.0);
        let mut index = 0;
        // Breadth first: the cap, if it is reached, cuts all branches at the same depth.
        while index < count {
            let Some(node) = tree.nodes().get(cut.nodes[index] as usize) else {
                break;
            };
            let (mut weights, angular_size_sq) = Weights::with_angular_size(node, receiver);
            tree.look_ahead(node, receiver, &mut weights);
            tree.leave_out(cut.nodes[index] as usize, &mut weights);
            // Children of other nodes are capped by the whole cut alone, below. Chosen by V.
            let has_steps = node.has_steps();
            if has_steps {
                tree.cap_uncertain(node, receiver, &mut weights);
            }
            if index == 0 {
                cut.inv_unit = weights.inv_unit;
            }
            tree.prefetch_below(node);
            let mut scale = weights.scale_to(cut.inv_unit, node.gain());
            if index > 0 {
                let expected = cut.totals[index];
                let (least, most) = if has_steps {
                    let rise = MAX_STEP_RISE * (root_total / expected);
                    (1.0 / MAX_STEP_REVISION, MAX_REVISION.min(1.0 + rise))
                } else {
                    (1.0 / MAX_REVISION, MAX_REVISION)
                };
                let revision = revision(weights.total * scale, expected, least, most);
                scale = positive_product(scale, revision).min(f32::MAX);
            }
            let lanes = &mut weights.lanes;
            for weight in lanes.iter_mut() {
                *weight = positive_product(*weight, scale);
            }
            if index == 0 {
                // Not a number counts as 0.
                root_total = total(lanes);
                limit = detail.threshold.max(0.0) * root_total;
            }
            let open_weights = open_weights(lanes, &angular_size_sq, node.inner);
            let mask = mask_above(&open_weights, limit);
            // A node whose children do not all fit opens none.
            let opened = append_set_bits(&mut cut.nodes, count, mask, node.child_base);
            if count + opened <= MAX_NODES {
                // What each is estimated at, until its own weights are known.
                let totals = cut.totals[count..][..opened].iter_mut();
                for (total, opened) in totals.zip(&cut.nodes[count..]) {
                    *total = lanes[(opened - node.child_base) as usize];
                }
                count += opened;
                for k in 0..WIDTH {
                    lanes[k] = if open_weights[k] > limit {
                        0.0
                    } else {
                        lanes[k]
                    };
                }
            }
            cut.weights[index] = *lanes;
            cut.totals[index] = total(lanes);
            cut.sum += cut.totals[index];
            index += 1;
        }
        cut.count = index;
        let most = MOST * cut.sum;
        if let Some(index) = cut.totals[..index].iter().position(|&total| total > most) {
            cut.cap_uncertain(tree, receiver, index);
        }
        cut.share_parts();
    }
}

impl CutNodes {
    /// Leaves some of the choices to the others where one child has most of the weights of the cut, and
    /// its lights may not reach the receiver: a child of the node that has most of them.
    #[cold]
    #[inline(never)]
    fn cap_uncertain<R: Receiver>(&mut self, tree: &LightBvhRef<'_>, receiver: &R, index: usize) {
        let most = MOST * self.sum;
        let largest = self.weights[index].iter().position(|&weight| weight > most);
        let (Some(k), Some(node)) = (largest, tree.nodes().get(self.nodes[index] as usize)) else {
            return;
        };
        let weight = core::mem::take(&mut self.weights[index][k]);
        let rest = self.sum_up(index);
        self.weights[index][k] = tree.capped(node, receiver, k, (weight, rest));
        self.sum_up(index);
    }

    /// Sets the sums after weights of a node have changed; the sum of all.
    fn sum_up(&mut self, index: usize) -> f32 {
        self.totals[index] = total(&self.weights[index]);
        self.sum = self.totals[..self.count].iter().sum();
        self.sum
    }

    /// Shares the parts of the choice between the nodes, by [`discrete`](light_math::discrete)'s
    /// rule.
    #[inline(always)]
    pub(crate) fn share_parts(&mut self) {
        let scale = parts_scale(self.sum, MAX_NODES);
        let ends = &mut self.ends[..self.count];
        // The parts of each, before they become ends.
        for (parts, &total) in ends.iter_mut().zip(&self.totals) {
            *parts = parts_of(total, scale);
        }
        // What is left over goes to the first with any weight.
        let mut left_over = PARTS.saturating_sub(ends.iter().sum());
        let mut end = 0;
        for place in ends {
            if *place > 0 {
                end += *place + core::mem::take(&mut left_over);
            }
            *place = end;
        }
    }
}

/// The factor that brings the weights of a node, `total` together, between `least` and `most` times
/// what the group was estimated at, `expected`.
#[inline(always)]
fn revision(total: f32, expected: f32, least: f32, most: f32) -> f32 {
    let ratio = (expected / total.max(f32::MIN_POSITIVE)).min(f32::MAX);
    (ratio * most).min((ratio * least).max(1.0))
}

/// How rough the estimate of each child is: its weight times the square of its angular size; 0 for
/// the lights behind the first `inner` children, which cannot be opened.
#[inline(always)]
fn open_weights(weights: &[f32; WIDTH], angular_size_sq: &[f32; WIDTH], inner: u8) -> [f32; WIDTH] {
    let inner = usize::from(inner);
    let mut open_weights = [0.0; WIDTH];
    for k in 0..WIDTH {
        open_weights[k] = if k < inner {
            weights[k] * angular_size_sq[k]
        } else {
            0.0
        };
    }
    open_weights
}

/// Bit `k` says whether number `k` is above `limit`.
#[inline(always)]
fn mask_above(numbers: &[f32; WIDTH], limit: f32) -> usize {
    let limit = Vec4::splat(limit);
    let mut mask = 0;
    for (i, four) in numbers.chunks_exact(4).enumerate() {
        mask |= (Vec4::from_slice(four).cmpgt(limit).bitmask() as usize) << (4 * i);
    }
    mask
}

/// Writes `first + k` for every bit `k` of `mask` from `at` on, and anything in the rest of the
/// next [`WIDTH`] places; returns how many.
///
/// By tables instead of branches, which would be mispredicted.
#[inline(always)]
fn append_set_bits(
    nodes: &mut [u32; MAX_NODES + WIDTH],
    at: usize,
    mask: usize,
    first: u32,
) -> usize {
    let (mut mask, mut first, mut appended) = (mask, first, 0);
    for _ in 0..WIDTH / 8 {
        let bits = mask & 0xff;
        for (i, place) in nodes[at + appended..][..8].iter_mut().enumerate() {
            *place = first.wrapping_add(PLACES[bits] >> (4 * i) & 0xf);
        }
        appended += usize::from(COUNTS[bits]);
        mask >>= 8;
        first = first.wrapping_add(8);
    }
    appended
}

const _: () = assert!(WIDTH % 8 == 0, "bits are appended by bytes");

/// For every byte the places of its bits, four bits each, the first one lowest.
const PLACES: [u32; 256] = places();

/// For every byte how many bits it has.
const COUNTS: [u8; 256] = counts();

const fn places() -> [u32; 256] {
    let mut all = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut bit, mut count) = (0, 0);
        while bit < 8 {
            if byte >> bit & 1 == 1 {
                all[byte] |= bit << (4 * count);
                count += 1;
            }
            bit += 1;
        }
        byte += 1;
    }
    all
}

const fn counts() -> [u8; 256] {
    let mut counts = [0; 256];
    let mut byte = 1;
    while byte < 256 {
        counts[byte] = counts[byte / 2] + if byte % 2 == 1 { 1 } else { 0 };
        byte += 1;
    }
    counts
}

#[cfg(test)]
mod tests;
