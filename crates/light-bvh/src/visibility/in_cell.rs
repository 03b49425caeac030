use light_bounds::{LightId, SampledLight};

use crate::importance::receiver::Receiver;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::into_receiver::{IntoReceiver, Query, QueryFor};
use crate::simd::dispatch;
use crate::visibility::cell_factors::CellFactors;
use crate::visibility::walk::{descend, pmf_along, root};
use crate::visibility::way::Way;

/// A tree with the factors of one cell: the importance of a child of a copied node is multiplied by
/// its factor.
///
/// All else is as in the tree: a light that can contribute has a probability above 0 whatever the
/// factors are. A `receiver` is a reference to a
/// [`LightSampleContext`](light_bounds::LightSampleContext), or to a [`Receiver`](crate::Receiver).
#[derive(Clone, Copy, Debug)]
pub struct LightBvhInCell<'a> {
    pub(super) tree: LightBvhRef<'a>,
    pub(super) cell: CellFactors<'a>,
}

impl<'a> LightBvhRef<'a> {
    /// The tree with the factors of `cell`, which was made for it.
    ///
    /// A cell of another tree gives other probabilities, but no light is lost by it.
    #[must_use]
    pub const fn in_cell(self, cell: CellFactors<'a>) -> LightBvhInCell<'a> {
        LightBvhInCell { tree: self, cell }
    }
}

impl LightBvhInCell<'_> {
    /// One light that may light `receiver`; `None` if no light in the tree can. `u` is a
    /// [fraction](light_math::fraction) of 2^64.
    #[must_use]
    pub fn sample(&self, receiver: impl IntoReceiver, u: u64) -> Option<SampledLight> {
        let within = &self.wanting(receiver);
        dispatch(QueryFor(&receiver.keep(), Sample { within, u }))
    }

    /// Probability that [`sample`](Self::sample) for `receiver` returns `light`, to the bit.
    #[must_use]
    pub fn pmf(&self, receiver: impl IntoReceiver, light: LightId) -> f32 {
        let within = &self.wanting(receiver);
        dispatch(QueryFor(&receiver.keep(), Probability { within, light }))
    }

    /// The same cell of the tree for the groups of `receiver`.
    #[inline(always)]
    pub(super) fn wanting(&self, receiver: impl IntoReceiver) -> Self {
        let tree = self.tree.wanting(receiver.groups());
        Self { tree, ..*self }
    }
}

/// [`LightBvhInCell::sample`].
struct Sample<'a, 'b> {
    within: &'b LightBvhInCell<'a>,
    u: u64,
}

impl Query for Sample<'_, '_> {
    type Output = Option<SampledLight>;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        let LightBvhInCell { tree, cell } = self.within;
        descend(tree, cell, receiver, &root(tree, cell, receiver), self.u)
    }
}

/// [`LightBvhInCell::pmf`].
struct Probability<'a, 'b> {
    within: &'b LightBvhInCell<'a>,
    light: LightId,
}

impl Query for Probability<'_, '_> {
    type Output = f32;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> f32 {
        let LightBvhInCell { tree, cell } = self.within;
        // Before any weight: the loads of the nodes overlap.
        match Way::of(tree, self.light) {
            Some(way) => pmf_along(tree, cell, receiver, &way, &root(tree, cell, receiver)),
            None => 0.0,
        }
    }
}
