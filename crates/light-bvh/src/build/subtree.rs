use alloc::vec::Vec;

use crate::build::node_children::{NodeChildren, is_depth_limited};
use crate::build::split_group::SplitGroup;
use crate::build::topology::{NodeCounts, Topology};
use crate::node::wide_node::MAX_DEPTH;
use crate::parallel::map;

/// A group whose parts may be built in parallel.
pub(crate) trait ParallelGroup: SplitGroup {
    /// A group of at most so many lights is built by one thread.
    const MAX_SERIAL_LIGHTS: usize;

    /// Builds the whole subtree by one thread.
    fn build_subtree(self, output: OutputSlice<'_>) -> Topology;
}

/// Where the lights of a subtree are written.
pub(crate) struct OutputSlice<'o> {
    /// Room for the ids of its lights.
    pub(crate) order: &'o mut [u32],
    /// Levels above it.
    pub(crate) depth: usize,
}

impl<'o> OutputSlice<'o> {
    /// The subtree over a group of any size.
    pub(crate) fn build<G: ParallelGroup>(self, group: G) -> Topology {
        let levels = MAX_DEPTH - self.depth;
        if group.lights() <= G::MAX_SERIAL_LIGHTS || is_depth_limited(group.lights(), levels) {
            return group.build_subtree(self);
        }
        let children = NodeChildren::new(group, levels);
        let (root, rest) = self.node(&children);
        let jobs = rest.split_among(children.into_nodes()).collect();
        let subtrees = map(jobs, |(group, output): (G, OutputSlice<'_>)| {
            output.build(group)
        });
        Topology::join(root, &subtrees)
    }

    /// The subtree over a group, built by one thread.
    pub(crate) fn build_serial<G: SplitGroup>(self, group: G) -> Topology {
        let mut counts = Vec::with_capacity(group.lights() / 4 + 1);
        counts.push(NodeCounts::default());
        self.build_serial_at(0, group, &mut counts);
        Topology(counts)
    }

    /// Builds the subtree of the node at `index` of `counts`.
    fn build_serial_at<G: SplitGroup>(self, index: usize, group: G, counts: &mut Vec<NodeCounts>) {
        let children = NodeChildren::new(group, MAX_DEPTH - self.depth);
        let (node, rest) = self.node(&children);
        counts[index] = node;
        let base = counts.len();
        counts.resize(base + usize::from(node.inner), NodeCounts::default());
        for (child, (group, output)) in (base..).zip(rest.split_among(children.into_nodes())) {
            output.build_serial_at(child, group, counts);
        }
    }

    /// The node over `children`, whose lights are put into their places, and the room that is left
    /// for what is below.
    fn node<G: SplitGroup>(self, children: &NodeChildren<G>) -> (NodeCounts, Self) {
        let (own, order) = self.order.split_at_mut(children.light_count());
        let counts = NodeCounts {
            inner: low_byte(children.node_count()),
            count: low_byte(children.node_count() + own.len()),
        };
        let mut places = own.iter_mut();
        children.each_light(|light| {
            if let Some(place) = places.next() {
                *place = light;
            }
        });
        let depth = self.depth + 1;
        (counts, OutputSlice { order, depth })
    }

    /// Each group with its part of the room.
    fn split_among<G: SplitGroup>(
        self,
        groups: impl Iterator<Item = G>,
    ) -> impl Iterator<Item = (G, Self)> {
        let (mut order, depth) = (self.order, self.depth);
        groups.map(move |group| {
            let (mine, rest) = core::mem::take(&mut order).split_at_mut(group.lights());
            order = rest;
            (group, OutputSlice { order: mine, depth })
        })
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "at most as many children as a node has slots"
)]
const fn low_byte(x: usize) -> u8 {
    x as u8
}
