//! How a [`LightCut`] is sampled.

use light_bounds::{LightId, LightSampleContext, SampledLight};

use crate::cut::light_cut::LightCut;
use crate::importance::receiver::Receiver;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::into_receiver::{Query, QueryFor};
use crate::query::select::{mul_prob, pick, share, to_f32};
use crate::simd::dispatch;

impl LightCut {
    /// One light that may light `ctx`, which has to be the one of the cut, as has the tree; `None`
    /// if no light in the tree can.
    ///
    /// `pmf` is the probability of another choice that led here, 1 if there was none. For `k`
    /// lights, call with `(i + u) / k` for `i` of `0..k`.
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
        dispatch(QueryFor(ctx, Sample { cut, tree, pmf, u }))
    }

    /// Calls `each` with what [`sample_at`](Self::sample_at) gives for each of `us`, in their
    /// order: faster than one by one.
    #[inline]
    pub fn sample_many_at(
        &self,
        tree: &LightBvhRef<'_>,
        ctx: &LightSampleContext,
        pmf: f32,
        us: impl IntoIterator<Item = f64>,
        each: impl FnMut(SampledLight),
    ) {
        let sample = SampleMany {
            cut: self,
            tree,
            pmf,
            us,
            each,
        };
        dispatch(QueryFor(ctx, sample));
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
        dispatch(QueryFor(
            ctx,
            Probability {
                cut: self,
                tree,
                pmf,
                light,
            },
        ))
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
        dispatch(QueryFor(receiver, Sample { cut, tree, pmf, u }))
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
        dispatch(QueryFor(
            receiver,
            Probability {
                cut: self,
                tree,
                pmf,
                light,
            },
        ))
    }
}

/// [`LightCut::sample_at`].
pub(crate) struct Sample<'a, 'b> {
    pub(crate) cut: &'b LightCut,
    pub(crate) tree: &'b LightBvhRef<'a>,
    pub(crate) pmf: f32,
    pub(crate) u: f64,
}

impl Query for Sample<'_, '_> {
    type Output = Option<SampledLight>;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        self.cut.choose(receiver, self.tree, self.pmf, self.u)
    }
}

/// [`LightCut::sample_many_at`].
pub(crate) struct SampleMany<'a, 'b, U, F> {
    pub(crate) cut: &'b LightCut,
    pub(crate) tree: &'b LightBvhRef<'a>,
    pub(crate) pmf: f32,
    pub(crate) us: U,
    pub(crate) each: F,
}

impl<U: IntoIterator<Item = f64>, F: FnMut(SampledLight)> Query for SampleMany<'_, '_, U, F> {
    type Output = ();

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) {
        let Self { cut, tree, pmf, .. } = self;
        let mut each = self.each;
        for u in self.us {
            if let Some(sample) = cut.choose(receiver, tree, pmf, u) {
                each(sample);
            }
        }
    }
}

/// [`LightCut::pmf_at`].
pub(crate) struct Probability<'a, 'b> {
    pub(crate) cut: &'b LightCut,
    pub(crate) tree: &'b LightBvhRef<'a>,
    pub(crate) pmf: f32,
    pub(crate) light: LightId,
}

impl Query for Probability<'_, '_> {
    type Output = f32;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> f32 {
        let Self { cut, pmf, .. } = self;
        self.tree.ascend(receiver, 0.0, self.light, |node, child| {
            let at = cut.nodes[..cut.count]
                .iter()
                .position(|&n| n as usize == node)?;
            Some(mul_prob(pmf, share(cut.weights[at][child], cut.sum)))
        })
    }
}

impl LightCut {
    #[inline(always)]
    fn choose<R: Receiver>(
        &self,
        receiver: &R,
        tree: &LightBvhRef<'_>,
        pmf: f32,
        u: f64,
    ) -> Option<SampledLight> {
        let total = self.total();
        if !(total > 0.0) {
            return None;
        }
        let target = u * total;
        let (index, within) = self.node_at(target)?;
        let (child, u) = pick(&self.weights[index], |_| within, to_f32(within))?;
        let pmf = mul_prob(pmf, share(self.weights[index][child], self.sum));
        tree.descend_from(receiver, self.nodes[index], child, pmf, u)
    }

    /// The node that `target`, from 0 to the sum of the weights, falls on, and how far into it.
    #[inline(always)]
    fn node_at(&self, target: f64) -> Option<(usize, f64)> {
        // All are compared, for a search that stops could not be foretold; in single precision,
        // which is right but for the nearest of misses.
        let about = to_f32(target);
        let guess: u32 = self.about.iter().map(|&end| u32::from(end <= about)).sum();
        let guess = guess as usize;
        let start = |index: usize| match index {
            0 => 0.0,
            _ => self.ends[index - 1],
        };
        let is_right =
            (guess < self.count) && (start(guess) <= target) && (target < self.ends[guess]);
        let index = if is_right {
            guess
        } else {
            self.search(target)?
        };
        Some((index, target - start(index)))
    }

    /// The same by binary search; the last node with any weight takes a target that rounding puts
    /// beyond the sum.
    #[cold]
    fn search(&self, target: f64) -> Option<usize> {
        let ends = self.ends.get(..self.count)?;
        let index = ends.partition_point(|&end| end <= target);
        if index < ends.len() {
            return Some(index);
        }
        Some(ends.partition_point(|&end| end < self.total()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cut of nodes whose weights end at `ends`.
    fn cut(ends: &[f64]) -> LightCut {
        let mut cut = LightCut::default();
        cut.ends[..ends.len()].copy_from_slice(ends);
        cut.about = cut.ends.map(to_f32);
        cut.count = ends.len();
        cut
    }

    #[test]
    fn the_last_node_with_any_weight_takes_what_rounding_leaves() {
        let cut = cut(&[1.0, 3.0, 3.0, 3.0]);
        assert_eq!(cut.node_at(0.0), Some((0, 0.0)), "the first");
        assert_eq!(cut.node_at(1.0), Some((1, 0.0)), "where the first ends");
        assert_eq!(cut.node_at(2.5), Some((1, 1.5)), "within the second");
        assert_eq!(cut.node_at(3.0), Some((1, 2.0)), "at the end");
        assert_eq!(cut.search(3.5), Some(1), "beyond the end");
    }

    #[test]
    fn a_node_of_any_weight_has_its_part() {
        let cut = cut(&[1.0, 1.0 + 1e-9, 1.0 + 2e-9, 2.0]);
        assert_eq!(
            cut.node_at(1.0 + 0.5e-9).map(|n| n.0),
            Some(1),
            "a billionth"
        );
        assert_eq!(cut.node_at(1.0 + 1.5e-9).map(|n| n.0), Some(2), "the next");
        assert_eq!(cut.node_at(1.0 + 2.5e-9).map(|n| n.0), Some(3), "beyond");
    }

    /// Rounded to single precision the target is at the end of a node that it is still within.
    #[test]
    fn a_target_just_below_an_end_is_within_its_node() {
        let cut = cut(&[1.0, 2.0, 4.0]);
        for end in [1.0f64, 2.0, 4.0] {
            let target = end * (1.0 - f64::EPSILON);
            let (index, within) = cut.node_at(target).expect("a node");
            let start = [0.0, 1.0, 2.0][index];
            assert_eq!(cut.ends[index], end, "{target}");
            assert_eq!(within, target - start, "{target}");
        }
    }
}
