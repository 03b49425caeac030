use alloc::vec;
use alloc::vec::Vec;

use light_bounds::{LightExtent, LightGroups, LightId, SampledLight};

use crate::LightBvhError;
use crate::build::builder::build;
use crate::build::lights::{LeafMoments, Lights};
use crate::build::options::LightBvhOptions;
use crate::build::scan::{Scan, expect_addressable};
use crate::build::{quality, refit};
use crate::node::moments::Moments;
use crate::node::wide_node::{NOWHERE, WIDTH, WideNode};
use crate::parallel::join;
use crate::query::bvh_ref::{LightBvhRef, groups_of_all};
use crate::query::into_receiver::IntoReceiver;

/// The default light hierarchy: chooses one of many lights about in proportion to its irradiance.
///
/// Sixteen children a node, each described by moments of its lights: the expected irradiance
/// instead of a bound of it, and zero only where no light can contribute. 24 to 29 bytes a light
/// from ten thousand lights on.
#[derive(Clone, Debug, Default)]
pub struct LightBvh {
    pub(crate) nodes: Vec<WideNode>,
    pub(crate) order: Vec<u32>,
    pub(crate) slots: Vec<u32>,
    pub(crate) power: f32,
    /// The groups of the lights of each child of each node; empty if all lights are in all groups.
    pub(crate) groups: Vec<[LightGroups; WIDTH]>,
}

impl LightBvh {
    /// The hierarchy of the bounded lights of `lights`, in which the index of an entry is its
    /// [`LightId`].
    ///
    /// Infinite lights, and lights without power, are not in the tree and have pmf 0.
    ///
    /// # Errors
    /// More than 2^28 lights; the first light with invalid bounds or a coordinate beyond ±1e36.
    pub fn build(lights: &[LightExtent]) -> Result<Self, LightBvhError> {
        Self::build_with(lights, &LightBvhOptions::default())
    }

    /// The same, built as `options` say.
    ///
    /// # Errors
    /// As for [`build`](Self::build).
    pub fn build_with(
        lights: &[LightExtent],
        options: &LightBvhOptions,
    ) -> Result<Self, LightBvhError> {
        expect_addressable(lights.len())?;
        let scan = Scan::of(lights, options.dark)?;
        let leaves = Lights::new(lights, scan.power);
        Ok(Self::build_of_leaves(lights, &scan, options, &leaves).0)
    }

    /// A tree whose topology is that of `lights`, which are valid, and whose leaves have the
    /// moments of `leaves`; and the moments of all of them together, whose power is a share of the
    /// tree's.
    pub(crate) fn build_of_leaves(
        lights: &[LightExtent],
        scan: &Scan,
        options: &LightBvhOptions,
        leaves: &impl LeafMoments,
    ) -> (Self, Moments) {
        let (topology, order) = build(lights, scan, options, 0);
        let mut nodes = topology.nodes();
        let (moments, slots) = join(
            lights.len(),
            || refit::fill(&mut nodes, 0, &order, leaves),
            || topology.slots(&order, lights.len()),
        );
        let tree = Self {
            nodes,
            order,
            slots,
            power: saturated(scan.power),
            groups: Vec::new(),
        };
        (tree, moments)
    }

    /// Refits the tree to lights that moved, turned, or changed their power: same topology, new
    /// moments.
    ///
    /// Linear in the lights, allocates nothing. A light that is off keeps its place and has pmf 0
    /// until it is on again. V grows as lights move away from their neighbours: see
    /// [`degradation`](Self::degradation).
    ///
    /// # Errors
    /// Those of [`build`](Self::build), [`LightBvhError::OtherLights`] if these are not as many
    /// lights as the tree was built for, and [`LightBvhError::NoPlace`] for the first one that
    /// emits, or is bounded, and was not when the tree was built. The tree does not change then.
    pub fn refit(&mut self, lights: &[LightExtent]) -> Result<(), LightBvhError> {
        let power = self.scan_refit(lights)?.power;
        self.refit_to_leaves(power, &Lights::new(lights, power));
        Ok(())
    }

    /// Validates the lights of a refit.
    pub(crate) fn scan_refit(&self, lights: &[LightExtent]) -> Result<Scan, LightBvhError> {
        if lights.len() != self.slots.len() {
            return Err(LightBvhError::OtherLights {
                expected: self.slots.len(),
            });
        }
        refit::scan(lights, &self.slots)
    }

    /// Refits the tree to leaves that are valid, of so much power together.
    pub(crate) fn refit_to_leaves(&mut self, power: f64, leaves: &impl LeafMoments) {
        self.power = saturated(power);
        refit::fill(&mut self.nodes, 0, &self.order, leaves);
    }

    /// What queries need, borrowed.
    #[inline]
    #[must_use]
    pub fn view(&self) -> LightBvhRef<'_> {
        LightBvhRef::new(&self.nodes, &self.order, &self.slots).with_groups(&self.groups)
    }

    /// Sets the groups of all lights, one entry for each in the order of ids. They stay through
    /// refits. 64 bytes a node, and a few instructions a node for contexts limited to some groups.
    ///
    /// # Errors
    /// [`LightBvhError::OtherLights`] if these are not as many as the lights.
    pub fn set_groups(&mut self, groups: &[LightGroups]) -> Result<(), LightBvhError> {
        if groups.len() != self.slots.len() {
            return Err(LightBvhError::OtherLights {
                expected: self.slots.len(),
            });
        }
        let mut of_nodes = vec![[LightGroups::NONE; WIDTH]; self.nodes.len()];
        for (&slot, &groups) in self.slots.iter().zip(groups) {
            if slot != NOWHERE {
                of_nodes[slot as usize / WIDTH][slot as usize % WIDTH] = groups;
            }
        }
        // Parents come before their children.
        for (index, node) in self.nodes.iter().enumerate().rev() {
            if node.parent != NOWHERE {
                let all = groups_of_all(&of_nodes[index]);
                of_nodes[node.parent as usize / WIDTH][node.parent as usize % WIDTH] = all;
            }
        }
        self.groups = of_nodes;
        Ok(())
    }

    /// The groups of the lights of each child of each node; empty before
    /// [`set_groups`](Self::set_groups).
    #[must_use]
    pub fn groups(&self) -> &[[LightGroups; WIDTH]] {
        &self.groups
    }

    /// One light that may light `receiver`; `None` if no light in the tree can: see
    /// [`LightBvhRef::sample`].
    #[inline]
    #[must_use]
    pub fn sample(&self, receiver: impl IntoReceiver, u: u64) -> Option<SampledLight> {
        self.view().sample(receiver, u)
    }

    /// Probability that [`sample`](Self::sample) for `receiver` returns `light`, to the bit.
    #[inline]
    #[must_use]
    pub fn pmf(&self, receiver: impl IntoReceiver, light: LightId) -> f32 {
        self.view().pmf(receiver, light)
    }

    /// The power of all lights of the tree; the largest float where it is above that.
    #[must_use]
    pub const fn power(&self) -> f32 {
        self.power
    }

    /// How much refits have degraded the tree: the mean ratio of the spread of a child to that of
    /// its parent, weighted by intensity.
    ///
    /// The spread is what the builder minimises: the standard deviation of the positions times
    /// `(1 + d)^(5/8)`, where `d` is the relative variance of the axes. 0 for a tree of one node.
    /// Compare it with the value of the freshly built tree: when [refits](Self::refit) have raised
    /// it by a tenth, V has grown too, and a new build pays. Linear in the nodes, allocates
    /// nothing, independent of scale.
    #[must_use]
    pub fn degradation(&self) -> f64 {
        quality::degradation(&self.nodes)
    }

    /// Bytes that queries may touch.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let tree = size_of_val(&*self.nodes) + size_of_val(&*self.order);
        tree + size_of_val(&*self.slots) + size_of_val(&*self.groups)
    }

    /// Levels of nodes, at most [`MAX_DEPTH`](crate::node::wide_node::MAX_DEPTH).
    #[must_use]
    pub fn depth(&self) -> usize {
        let mut levels = vec![0; self.nodes.len()];
        let mut deepest = 0;
        for (index, node) in self.nodes.iter().enumerate() {
            // Parents come before their children.
            levels[index] = match node.parent {
                NOWHERE => 1,
                parent => levels[parent as usize / WIDTH] + 1,
            };
            deepest = deepest.max(levels[index]);
        }
        deepest
    }
}

#[expect(clippy::cast_possible_truncation, reason = "rounds a power")]
pub(crate) const fn saturated(power: f64) -> f32 {
    (power as f32).min(f32::MAX)
}
