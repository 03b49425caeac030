use light_bounds::{LightId, LightSampleContext, SampledLight};

use super::importance::Receiver;
use super::node::{NOWHERE, WIDTH};
use super::query::{Oneself, Query};
use super::select::{both, low, pick, share};
use super::tree::{LightBvhRef, MAX_DEPTH};
use super::vectors::{answer, prefetch};
use super::weights::Weights;

/// Nodes that a cut may hold.
const MAX_NODES: usize = 24;

/// How much more a nearer node may count per unit of its weight: where distances differ by more than 2^30, weights lose their proportion
/// and keep their sign.
const MAX_ZOOM: f32 = 1_073_741_824.0;

/// Where a cut stops to look closer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutDetail {
    /// A group of lights is opened while its share of the whole, times how uncertain its distance makes it, is above this.
    pub threshold: f32,
}

impl Default for CutDetail {
    fn default() -> Self {
        Self { threshold: 0.02 }
    }
}

/// A cut through the tree for one receiver: where the estimate is rough, it is looked at more closely before anything is chosen.
///
/// A value of its own, without memory elsewhere: a pure function of tree, receiver and [`CutDetail`]. It pays when several lights are chosen
/// for the same receiver, each by a part of one stratified `u`. At most 24 nodes, about 1.7 KB.
#[derive(Clone, Copy, Debug)]
pub struct LightCut {
    /// The nodes that are in the cut, each with the weights of those children that are not; and one place more than they may fill.
    nodes: [u32; MAX_NODES + 1],
    weights: [[f32; WIDTH]; MAX_NODES],
    /// Sums of the weights of all nodes up to each.
    ends: [f32; MAX_NODES],
    count: usize,
    /// One over the root's unit of length, in which the weights are.
    inv_unit: f32,
}

impl LightCut {
    /// The cut of `tree` for `ctx`.
    #[must_use]
    pub fn at(tree: &LightBvhRef<'_>, ctx: &LightSampleContext, detail: CutDetail) -> Self {
        answer(ctx, Grow { tree, detail })
    }

    /// The cut of `tree` for `receiver`.
    #[must_use]
    pub fn new<R: Receiver>(tree: &LightBvhRef<'_>, receiver: &R, detail: CutDetail) -> Self {
        answer(Oneself(receiver), Grow { tree, detail })
    }

    /// One light that may light `ctx`, which has to be the one of the cut, as has the tree; `None` if no light in the tree can.
    ///
    /// `pmf` is the probability of another choice that led here, 1 if there was none. For `k` lights, call with `(i + u) / k` for `i` of
    /// `0..k`.
    #[inline]
    #[must_use]
    pub fn sample_at(
        &self,
        tree: &LightBvhRef<'_>,
        ctx: &LightSampleContext,
        pmf: f32,
        u: f64,
    ) -> Option<SampledLight> {
        let cut = self;
        answer(ctx, Sample { cut, tree, pmf, u })
    }

    /// Probability of `light` by [`sample_at`](Self::sample_at), to the bit.
    #[inline]
    #[must_use]
    pub fn pmf_at(
        &self,
        tree: &LightBvhRef<'_>,
        ctx: &LightSampleContext,
        pmf: f32,
        light: LightId,
    ) -> f32 {
        answer(
            ctx,
            Probability {
                cut: self,
                tree,
                pmf,
                light,
            },
        )
    }

    /// [`sample_at`](Self::sample_at) for the `receiver` of the cut.
    #[inline]
    #[must_use]
    pub fn sample<R: Receiver>(
        &self,
        tree: &LightBvhRef<'_>,
        receiver: &R,
        pmf: f32,
        u: f64,
    ) -> Option<SampledLight> {
        let cut = self;
        answer(Oneself(receiver), Sample { cut, tree, pmf, u })
    }

    /// [`pmf_at`](Self::pmf_at) for the `receiver` of the cut.
    #[inline]
    #[must_use]
    pub fn pmf<R: Receiver>(
        &self,
        tree: &LightBvhRef<'_>,
        receiver: &R,
        pmf: f32,
        light: LightId,
    ) -> f32 {
        answer(
            Oneself(receiver),
            Probability {
                cut: self,
                tree,
                pmf,
                light,
            },
        )
    }

    /// About the irradiance, or in a medium the fluence, by all lights of a tree of power 1; 0 only if none of them can contribute.
    #[must_use]
    pub fn irradiance(&self) -> f64 {
        let inv_unit = f64::from(self.inv_unit);
        // Heights and intensities are counted twice each.
        0.25 * f64::from(self.total()) * inv_unit * inv_unit
    }

    fn total(&self) -> f32 {
        self.count
            .checked_sub(1)
            .map_or(0.0, |last| self.ends[last])
    }

    /// Where in the cut the node is.
    #[inline]
    fn position(&self, node: u32) -> Option<usize> {
        self.nodes[..self.count].iter().position(|&n| n == node)
    }
}

/// [`LightCut::at`].
struct Grow<'a, 'b> {
    tree: &'b LightBvhRef<'a>,
    detail: CutDetail,
}

impl Query for Grow<'_, '_> {
    type Answer = LightCut;

    #[inline(always)]
    fn of<R: Receiver>(self, receiver: &R) -> LightCut {
        let Self { tree, detail } = self;
        let mut cut = LightCut {
            nodes: [0; MAX_NODES + 1],
            weights: [[0.0; WIDTH]; MAX_NODES],
            ends: [0.0; MAX_NODES],
            count: usize::from(!tree.is_empty()),
            inv_unit: 1.0,
        };
        let mut limit = 0.0;
        let mut end = 0.0;
        let mut index = 0;
        // Breadth first: the cap, if it is reached, cuts all branches at the same depth.
        while index < cut.count {
            let Some(node) = tree.nodes().get(cut.nodes[index] as usize) else {
                break;
            };
            let (weights, roughness) = Weights::with_roughness(node, receiver);
            if index == 0 {
                cut.inv_unit = weights.inv_unit;
            }
            prefetch(tree.nodes(), node.child_base);
            let zoom = (weights.inv_unit / cut.inv_unit).min(MAX_ZOOM);
            let scale = node.gain() * zoom * zoom;
            let mut lanes = weights.lanes.map(|w| both(w, scale));
            if index == 0 {
                limit = detail.threshold * lanes.iter().sum::<f32>();
                limit *= limit;
            }
            let room = MAX_NODES - cut.count;
            let inner = usize::from(node.inner).min(WIDTH);
            let opens: [bool; WIDTH] = core::array::from_fn(|k| {
                (lanes[k] * lanes[k] * roughness[k] > limit) & (k < inner)
            });
            // Without branches, for they could not be foretold; so each child is noted, and the next one over it unless it is to be opened.
            let mut opened = 0;
            for k in 0..WIDTH {
                let open = opens[k] & (opened < room);
                cut.nodes[cut.count + opened] = node.child_base.wrapping_add(low_word(k));
                opened += usize::from(open);
                lanes[k] = if open { 0.0 } else { lanes[k] };
            }
            cut.count += opened;
            end += lanes.iter().sum::<f32>();
            cut.weights[index] = lanes;
            cut.ends[index] = end;
            index += 1;
        }
        cut.count = index;
        cut
    }
}

/// [`LightCut::sample_at`].
struct Sample<'a, 'b> {
    cut: &'b LightCut,
    tree: &'b LightBvhRef<'a>,
    pmf: f32,
    u: f64,
}

impl Query for Sample<'_, '_> {
    type Answer = Option<SampledLight>;

    #[inline(always)]
    fn of<R: Receiver>(self, receiver: &R) -> Self::Answer {
        let LightCut { nodes, weights, .. } = self.cut;
        let total = self.cut.total();
        if !(total > 0.0) {
            return None;
        }
        let target = self.u * f64::from(total);
        let ends = &self.cut.ends[..self.cut.count];
        let mut index = ends.partition_point(|&end| f64::from(end) <= target);
        if index == ends.len() {
            // The last node with any weight takes what rounding leaves beyond the sum.
            index = ends.partition_point(|&end| end < total);
        }
        let start = index.checked_sub(1).map_or(0.0, |before| ends[before]);
        let within = target - f64::from(start);
        let (child, u) = pick(&weights[index], within, low(within))?;
        let pmf = both(self.pmf, share(weights[index][child], total));
        self.tree
            .descend_from(receiver, nodes[index], child, pmf, u)
    }
}

/// [`LightCut::pmf_at`].
struct Probability<'a, 'b> {
    cut: &'b LightCut,
    tree: &'b LightBvhRef<'a>,
    pmf: f32,
    light: LightId,
}

impl Query for Probability<'_, '_> {
    type Answer = f32;

    #[inline(always)]
    fn of<R: Receiver>(self, receiver: &R) -> f32 {
        let Self { cut, tree, .. } = self;
        let mut shares = [0.0; MAX_DEPTH];
        let mut slot = tree.slot(self.light);
        let mut levels = 0;
        while slot != NOWHERE {
            let (index, child) = (slot as usize / WIDTH, slot as usize % WIDTH);
            if let Some(member) = cut.position(low_word(index)) {
                let pmf = both(self.pmf, share(cut.weights[member][child], cut.total()));
                return shares[..levels].iter().rev().fold(pmf, |p, &s| both(p, s));
            }
            let (Some(node), Some(share)) = (tree.nodes().get(index), shares.get_mut(levels))
            else {
                return 0.0;
            };
            *share = Weights::new(node, receiver).probability(child);
            levels += 1;
            slot = node.parent;
        }
        0.0
    }
}

#[expect(clippy::cast_possible_truncation, reason = "below the width of a node")]
const fn low_word(x: usize) -> u32 {
    x as u32
}
