use core::error::Error;
use core::fmt;

use light_bounds::{LightId, LightSampleContext, SampledLight};

use crate::cut::grow::Grow;
use crate::cut::sample::{Probability, Sample, SampleMany};
use crate::importance::surface::Receiver;
use crate::node::wide_node::WIDTH;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::into_receiver::Oneself;
use crate::simd::answer;

/// Nodes that a cut may hold.
pub(crate) const MAX_NODES: usize = 24;

/// Where a cut stops to look closer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutDetail {
    pub(crate) threshold: f32,
}

/// Why a number is no [`CutDetail`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CutDetailError {
    /// The threshold is negative or NaN: a group of no weight would be opened.
    Threshold,
}

impl CutDetail {
    /// A group of lights is opened while its share of the whole, times its squared width over its squared distance, is above
    /// `threshold`, a number of at least 0.
    ///
    /// # Errors
    /// When `threshold` is negative or NaN.
    pub fn new(threshold: f32) -> Result<Self, CutDetailError> {
        if !(threshold >= 0.0) {
            return Err(CutDetailError::Threshold);
        }
        Ok(Self { threshold })
    }

    /// The number above which a group is opened.
    #[must_use]
    pub const fn threshold(self) -> f32 {
        self.threshold
    }
}

impl fmt::Display for CutDetailError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Threshold => f.write_str("threshold: must be at least 0"),
        }
    }
}

impl Error for CutDetailError {}

impl Default for CutDetail {
    fn default() -> Self {
        Self { threshold: 0.08 }
    }
}

/// A cut through the tree for one receiver: where the estimate is rough, it is looked at more closely before anything is chosen.
///
/// A value of its own, without memory elsewhere: a pure function of tree, receiver and [`CutDetail`]. It pays when several lights are chosen
/// for the same receiver, each by a part of one stratified `u`. At most 24 nodes, about 2 KB.
#[derive(Clone, Copy, Debug)]
pub struct LightCut {
    /// The nodes that are in the cut, each with the weights of those children that are not; and room to note all children of one.
    pub(crate) nodes: [u32; MAX_NODES + WIDTH],
    pub(crate) weights: [[f32; WIDTH]; MAX_NODES],
    /// Sums of the weights of all nodes up to each; infinite beyond the last. In double precision, so that a node of any weight above 2^-53 of the
    /// whole owns a part of it.
    pub(crate) ends: [f64; MAX_NODES],
    /// The same in single precision, to search in.
    pub(crate) about: [f32; MAX_NODES],
    /// The sum of all weights, added in single precision.
    pub(crate) sum: f32,
    pub(crate) count: usize,
    /// One over the root's unit of length, in which the weights are.
    pub(crate) inv_unit: f32,
}

impl Default for LightCut {
    /// A cut in which there is no light.
    fn default() -> Self {
        Self::EMPTY
    }
}

impl LightCut {
    /// No node.
    const EMPTY: Self = Self {
        nodes: [0; MAX_NODES + WIDTH],
        weights: [[0.0; WIDTH]; MAX_NODES],
        ends: [f64::INFINITY; MAX_NODES],
        about: [f32::INFINITY; MAX_NODES],
        sum: 0.0,
        count: 0,
        inv_unit: 1.0,
    };

    /// The cut of `tree` for `ctx`.
    #[must_use]
    pub fn at(tree: &LightBvhRef<'_>, ctx: &LightSampleContext, detail: CutDetail) -> Self {
        let mut cut = Self::EMPTY;
        cut.look_at(tree, ctx, detail);
        cut
    }

    /// Becomes the cut of `tree` for `ctx`, in the same place: [`at`](Self::at) without a copy.
    pub fn look_at(&mut self, tree: &LightBvhRef<'_>, ctx: &LightSampleContext, detail: CutDetail) {
        let into = self;
        answer(ctx, Grow { tree, detail, into });
    }

    /// The cut of `tree` for `receiver`.
    #[must_use]
    pub fn new<R: Receiver>(tree: &LightBvhRef<'_>, receiver: &R, detail: CutDetail) -> Self {
        let mut cut = Self::EMPTY;
        let into = &mut cut;
        answer(Oneself(receiver), Grow { tree, detail, into });
        cut
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

    /// Calls `each` with what [`sample_at`](Self::sample_at) gives for each of `us`, in their order: quicker than to ask one by one.
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
        answer(ctx, sample);
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
        0.25 * f64::from(self.sum) * inv_unit * inv_unit
    }

    /// The sum of all weights, to the last digit of the ends.
    #[inline(always)]
    pub(crate) fn total(&self) -> f64 {
        self.count
            .checked_sub(1)
            .map_or(0.0, |last| self.ends[last])
    }
}
