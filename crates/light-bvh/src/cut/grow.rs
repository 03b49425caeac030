//! How a [`LightCut`] is grown.

use light_bounds::LightSampleContext;
use light_math::glam::Vec4;

use crate::cut::light_cut::{CutDetail, LightCut, MAX_NODES};
use crate::importance::receiver::Receiver;
use crate::node::wide_node::WIDTH;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::into_receiver::{Query, QueryFor};
use crate::query::select::{mul_prob, to_f32};
use crate::query::weights::{Weights, total};
use crate::simd::dispatch;

/// How much more a nearer node may count per unit of its weight: where distances differ by more
/// than 2^30, weights lose their proportion and keep their sign.
const MAX_ZOOM: f32 = 1_073_741_824.0;

impl LightCut {
    /// The cut of `tree` for `ctx`.
    #[must_use]
    pub fn at(tree: &LightBvhRef<'_>, ctx: &LightSampleContext, detail: CutDetail) -> Self {
        let mut cut = Self::EMPTY;
        cut.rebuild(tree, ctx, detail);
        cut
    }

    /// Becomes the cut of `tree` for `ctx`, in the same place: [`at`](Self::at) without a copy.
    pub fn rebuild(&mut self, tree: &LightBvhRef<'_>, ctx: &LightSampleContext, detail: CutDetail) {
        let into = self;
        dispatch(QueryFor(ctx, Grow { tree, detail, into }));
    }

    /// The cut of `tree` for `receiver`.
    #[must_use]
    pub fn new<R: Receiver>(tree: &LightBvhRef<'_>, receiver: &R, detail: CutDetail) -> Self {
        let mut cut = Self::EMPTY;
        let into = &mut cut;
        dispatch(QueryFor(receiver, Grow { tree, detail, into }));
        cut
    }
}

/// [`LightCut::rebuild`]: whatever the cut held is gone.
pub(crate) struct Grow<'a, 'b> {
    pub(crate) tree: &'b LightBvhRef<'a>,
    pub(crate) detail: CutDetail,
    pub(crate) into: &'b mut LightCut,
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
        cut.nodes[0] = 0;
        let mut limit = 0.0;
        let mut end = 0.0;
        cut.sum = 0.0;
        let mut index = 0;
        // Breadth first: the cap, if it is reached, cuts all branches at the same depth.
        while index < count {
            let Some(node) = tree.nodes().get(cut.nodes[index] as usize) else {
                break;
            };
            let (weights, angular_size_sq) = Weights::with_angular_size(node, receiver);
            if index == 0 {
                cut.inv_unit = weights.inv_unit;
            }
            tree.prefetch_below(node);
            let zoom = (weights.inv_unit / cut.inv_unit).min(MAX_ZOOM);
            let scale = (node.gain() * zoom * zoom).max(f32::MIN_POSITIVE);
            let mut lanes = weights.lanes;
            for weight in &mut lanes {
                *weight = mul_prob(*weight, scale);
            }
            if index == 0 {
                // Not a number counts as 0.
                limit = detail.threshold.max(0.0) * total(lanes);
            }
            let open_weights = open_weights(&lanes, &angular_size_sq, node.inner);
            let mask = mask_above(&open_weights, limit);
            // A node whose children do not all fit opens none.
            let opened = append_set_bits(&mut cut.nodes, count, mask, node.child_base);
            if count + opened <= MAX_NODES {
                count += opened;
                for k in 0..WIDTH {
                    lanes[k] = if open_weights[k] > limit {
                        0.0
                    } else {
                        lanes[k]
                    };
                }
            }
            cut.sum += total(lanes);
            end += precise_total(&lanes);
            cut.weights[index] = lanes;
            cut.ends[index] = end;
            cut.about[index] = to_f32(end);
            index += 1;
        }
        cut.count = index;
        cut.ends[index..].fill(f64::INFINITY);
        cut.about[index..].fill(f32::INFINITY);
    }
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

/// The sum of all lanes in double precision, in pairs.
#[inline(always)]
fn precise_total(lanes: &[f32; WIDTH]) -> f64 {
    let mut sums = lanes.map(f64::from);
    let mut half = WIDTH / 2;
    while half > 0 {
        for k in 0..half {
            sums[k] += sums[k + half];
        }
        half /= 2;
    }
    sums[0]
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
static PLACES: [u32; 256] = places();

/// For every byte how many bits it has.
static COUNTS: [u8; 256] = counts();

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
mod tests {
    use super::*;

    #[test]
    fn bits_are_appended_in_their_order() {
        for mask in (0..1 << WIDTH).step_by(97) {
            let mut nodes = [0; MAX_NODES + WIDTH];
            let appended = append_set_bits(&mut nodes, MAX_NODES, mask, 1000);
            let expected = (0..WIDTH).zip(1000..).filter(|(k, _)| mask >> k & 1 == 1);
            let expected = expected.map(|(_, node)| node);
            assert_eq!(appended, expected.clone().count(), "{mask:b}");
            assert!(
                nodes[MAX_NODES..][..appended].iter().copied().eq(expected),
                "{mask:b}: {nodes:?}"
            );
        }
    }

    #[test]
    fn only_numbers_above_count() {
        let mut numbers = [0.5; WIDTH];
        (numbers[1], numbers[WIDTH - 1], numbers[3]) = (0.6, 2.0, f32::NAN);
        assert_eq!(mask_above(&numbers, 0.5), 1 << 1 | 1 << (WIDTH - 1));
    }
}
