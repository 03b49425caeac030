use core::error::Error;
use core::fmt;

use crate::node::wide_node::WIDTH;
use crate::query::weights::irradiance;

/// Nodes that a cut may hold.
pub(crate) const MAX_NODES: usize = 24;

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
        Self { threshold: 0.08 }
    }
}

/// A cut through the tree for one receiver: groups whose estimate is rough are opened before any
/// light is chosen.
///
/// A pure function of tree, receiver and [`CutDetail`] that allocates nothing. It pays when several
/// lights are chosen for the same receiver, each by a part of one stratified `u`. At most 24 nodes,
/// about 2 KB.
#[derive(Clone, Copy, Debug)]
pub struct LightCut {
    /// The nodes that are in the cut, each with the weights of those children that are not; and
    /// room to note all children of one.
    pub(crate) nodes: [u32; MAX_NODES + WIDTH],
    pub(crate) weights: [[f32; WIDTH]; MAX_NODES],
    /// Sums of the weights of all nodes up to each; infinite beyond the last. In double precision,
    /// so that a node of any weight above 2^-53 of the whole owns a part of it.
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
    pub(crate) const EMPTY: Self = Self {
        nodes: [0; MAX_NODES + WIDTH],
        weights: [[0.0; WIDTH]; MAX_NODES],
        ends: [f64::INFINITY; MAX_NODES],
        about: [f32::INFINITY; MAX_NODES],
        sum: 0.0,
        count: 0,
        inv_unit: 1.0,
    };

    /// About the irradiance, or in a medium the fluence, by all lights of a tree of power 1; 0 only
    /// if none of them can contribute.
    #[must_use]
    pub fn irradiance(&self) -> f64 {
        irradiance(self.sum, self.inv_unit)
    }

    /// The sum of all weights, to the last digit of the ends.
    #[inline(always)]
    pub(crate) fn total(&self) -> f64 {
        self.count
            .checked_sub(1)
            .map_or(0.0, |last| self.ends[last])
    }
}
