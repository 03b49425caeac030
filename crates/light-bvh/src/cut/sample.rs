//! How a [`LightCut`] is sampled.

use light_bounds::{LightId, SampledLight};

use crate::cut::light_cut::LightCut;
use crate::importance::surface::Receiver;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::into_receiver::Query;
use crate::query::select::{both, low, pick, share};

/// [`LightCut::sample_at`].
pub(crate) struct Sample<'a, 'b> {
    pub(crate) cut: &'b LightCut,
    pub(crate) tree: &'b LightBvhRef<'a>,
    pub(crate) pmf: f32,
    pub(crate) u: f64,
}

impl Query for Sample<'_, '_> {
    type Answer = Option<SampledLight>;

    #[inline(always)]
    fn of<R: Receiver>(self, receiver: &R) -> Self::Answer {
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
    type Answer = ();

    #[inline(always)]
    fn of<R: Receiver>(self, receiver: &R) {
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
    type Answer = f32;

    #[inline(always)]
    fn of<R: Receiver>(self, receiver: &R) -> f32 {
        let Self { cut, pmf, .. } = self;
        self.tree.ascend(receiver, 0.0, self.light, |node, child| {
            let at = cut.nodes[..cut.count]
                .iter()
                .position(|&n| n as usize == node)?;
            Some(both(pmf, share(cut.weights[at][child], cut.sum)))
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
        let (child, u) = pick(&self.weights[index], |_| within, low(within))?;
        let pmf = both(pmf, share(self.weights[index][child], self.sum));
        tree.descend_from(receiver, self.nodes[index], child, pmf, u)
    }

    /// The node that `target`, from 0 to the sum of the weights, falls on, and how far into it.
    #[inline(always)]
    fn node_at(&self, target: f64) -> Option<(usize, f64)> {
        // All are compared, for a search that stops could not be foretold; in single precision, which is right but for the nearest of misses.
        let about = low(target);
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

    /// The same, looked for; the last node with any weight takes what rounding leaves beyond the sum.
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
        cut.about = cut.ends.map(low);
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
