use light_bounds::{LightId, SampledLight};

use crate::importance::context_receiver::ContextReceiver;
use crate::importance::receiver::Receiver;
use crate::query::into_receiver::{IntoReceiver, KeptReceiver, Query, QueryFor};
use crate::query::weights::Weights;
use crate::simd::dispatch;
use crate::visibility::in_cell::LightBvhInCell;
use crate::visibility::walk::{descend, pmf_along, root};
use crate::visibility::way::Way;

/// A tree as one receiver in a cell sees it: the root is evaluated once for all queries.
///
/// The probabilities have the bits of [`LightBvhInCell::sample`] and [`LightBvhInCell::pmf`].
#[derive(Clone, Copy, Debug)]
pub struct LightBvhInCellAt<'a, R = ContextReceiver> {
    within: LightBvhInCell<'a>,
    receiver: R,
    root: Weights,
}

impl<'a> LightBvhInCell<'a> {
    /// The tree as `receiver` sees it.
    #[must_use]
    pub fn at<A: IntoReceiver>(&self, receiver: A) -> LightBvhInCellAt<'a, A::Kept> {
        let within = self.wanting(receiver);
        let receiver = receiver.keep();
        LightBvhInCellAt {
            within,
            receiver,
            root: dispatch(QueryFor(&receiver, Root { within: &within })),
        }
    }
}

impl<R: KeptReceiver> LightBvhInCellAt<'_, R> {
    /// An estimate of the irradiance that arrives from all lights of a tree of power 1:
    /// [`LightBvhAt::irradiance`](crate::LightBvhAt::irradiance) with the factors of the root's
    /// children. 0 only if no light can contribute.
    #[inline]
    #[must_use]
    pub fn irradiance(&self) -> f32 {
        let root = self.within.tree.nodes().first();
        root.map_or(0.0, |root| self.root.irradiance(root))
    }

    /// One light that may light the receiver; `None` if no light in the tree can.
    #[must_use]
    pub fn sample(&self, u: u64) -> Option<SampledLight> {
        dispatch(QueryFor(&self.receiver, FromRoot { at: self, u }))
    }

    /// Probability that [`sample`](Self::sample) returns `light`, to the bit.
    #[must_use]
    pub fn pmf(&self, light: LightId) -> f32 {
        dispatch(QueryFor(&self.receiver, AlongWay { at: self, light }))
    }
}

/// The weights of the root's children.
struct Root<'a, 'b> {
    within: &'b LightBvhInCell<'a>,
}

impl Query for Root<'_, '_> {
    type Output = Weights;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Weights {
        root(&self.within.tree, &self.within.cell, receiver)
    }
}

/// [`LightBvhInCellAt::sample`].
struct FromRoot<'a, 'b, K> {
    at: &'b LightBvhInCellAt<'a, K>,
    u: u64,
}

impl<K> Query for FromRoot<'_, '_, K> {
    type Output = Option<SampledLight>;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        let LightBvhInCell { tree, cell } = &self.at.within;
        descend(tree, cell, receiver, &self.at.root, self.u)
    }
}

/// [`LightBvhInCellAt::pmf`].
struct AlongWay<'a, 'b, K> {
    at: &'b LightBvhInCellAt<'a, K>,
    light: LightId,
}

impl<K> Query for AlongWay<'_, '_, K> {
    type Output = f32;

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> f32 {
        let LightBvhInCell { tree, cell } = &self.at.within;
        match Way::of(tree, self.light) {
            Some(way) => pmf_along(tree, cell, receiver, &way, &self.at.root),
            None => 0.0,
        }
    }
}
