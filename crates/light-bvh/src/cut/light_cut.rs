use core::error::Error;
use core::fmt;

use light_math::discrete::PARTS;

use crate::importance::context_receiver::ContextReceiver;
use crate::importance::medium::MediumReceiver;
use crate::node::wide_node::WIDTH;
use crate::query::bvh_ref::LightBvhRef;
use crate::query::weights::{Weights, irradiance};

/// Nodes that a cut may hold.
pub(crate) const MAX_NODES: usize = 24;

/// The threshold of the default detail.
pub(crate) const THRESHOLD: f32 = 0.08;

/// How far a cut is refined.
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
    /// The most nodes of a cut, however fine.
    pub const MAX_NODES: usize = MAX_NODES;

    /// A group of lights is opened while its share of the whole, times its squared width over its
    /// squared distance, is above `threshold`, a number of at least 0.
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
        Self {
            threshold: THRESHOLD,
        }
    }
}

/// A cut through the tree for one receiver: groups whose estimate is rough are opened before any
/// light is chosen.
///
/// A pure function of tree, receiver and [`CutDetail`] that allocates nothing. It pays when several
/// lights are chosen for the same receiver, each by a part of one stratified `u`. Its probabilities
/// are its own: closer to the lights' contributions than those of the tree. At most 24 nodes, about
/// 2 KB: who keeps one for many receivers [sets](Self::set) it again.
#[derive(Clone, Debug)]
pub struct LightCut<'a, R = ContextReceiver> {
    pub(crate) tree: LightBvhRef<'a>,
    pub(crate) receiver: R,
    pub(crate) grown: CutNodes,
}

/// The nodes of a cut, each with the weights of those children that are not in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CutNodes {
    /// With room to note all children of one.
    pub(crate) nodes: [u32; MAX_NODES + WIDTH],
    pub(crate) weights: [[f32; WIDTH]; MAX_NODES],
    /// The sum of the weights of each node.
    pub(crate) totals: [f32; MAX_NODES],
    /// Where the parts of each node end; all parts beyond the last.
    pub(crate) ends: [u32; MAX_NODES],
    /// The sum of all weights.
    pub(crate) sum: f32,
    pub(crate) count: usize,
    /// One over the root's unit of length, in which the weights are.
    pub(crate) inv_unit: f32,
}

impl<R> LightCut<'_, R> {
    /// Nodes of the tree that the cut holds, from 0 (a tree without lights) to
    /// [`CutDetail::MAX_NODES`]. To make a cut costs about as much as to descend so many levels.
    #[must_use]
    pub const fn node_count(&self) -> usize {
        self.grown.count
    }

    /// About the irradiance, or in a medium the fluence, by all lights of a tree of power 1; 0 only
    /// if none of them can contribute.
    #[must_use]
    pub fn irradiance(&self) -> f32 {
        irradiance(self.grown.sum, self.grown.inv_unit, 1.0)
    }
}

/// The cut of a tree without lights.
impl Default for LightCut<'_> {
    #[inline]
    fn default() -> Self {
        Self {
            tree: LightBvhRef::new(&[], &[], &[]),
            receiver: ContextReceiver::Medium(MediumReceiver::ORIGIN),
            grown: CutNodes::none(),
        }
    }
}

impl CutNodes {
    const NONE: Self = Self::stored();

    /// No node. A GPU would copy the constant byte by byte, and others take a second place on the
    /// stack for what is stored number by number.
    #[inline(always)]
    pub(crate) const fn none() -> Self {
        if cfg!(target_arch = "nvptx64") {
            Self::stored()
        } else {
            Self::NONE
        }
    }

    /// No node, stored number by number.
    #[inline(always)]
    const fn stored() -> Self {
        let mut none = Self {
            // Of all but the first nothing is read.
            nodes: [1; MAX_NODES + WIDTH],
            weights: [[1.0; WIDTH]; MAX_NODES],
            totals: [1.0; MAX_NODES],
            ends: [PARTS; MAX_NODES],
            sum: 0.0,
            count: 0,
            inv_unit: 1.0,
        };
        none.clear();
        none
    }

    /// No node any more; of the others nothing is read.
    #[inline(always)]
    pub(crate) const fn clear(&mut self) {
        self.nodes[0] = 0;
        self.ends = [PARTS; MAX_NODES];
        self.sum = 0.0;
        self.count = 0;
        self.inv_unit = 1.0;
    }

    /// The weights of one of the nodes.
    #[inline(always)]
    pub(crate) fn weights(&self, index: usize) -> Weights {
        Weights {
            lanes: self.weights[index],
            total: self.totals[index],
            inv_unit: self.inv_unit,
            ..Weights::NONE
        }
    }

    /// Where the parts of one of the nodes begin, and how many they are.
    #[inline(always)]
    pub(crate) fn parts(&self, index: usize) -> (u32, u32) {
        let start = match index {
            0 => 0,
            _ => self.ends[index - 1],
        };
        (start, self.ends[index] - start)
    }
}
