use alloc::vec::Vec;
use std::io;

use crate::build::builder::build;
use crate::build::lights::Lights;
use crate::build::options::LightBvhOptions;
use crate::build::refit;
use crate::node::moments::Moments;
use crate::node::wide_node::WideNode;
use crate::out_of_core::group::Group;

/// A group and the levels of the upper tree above it.
pub(super) struct PlacedGroup {
    pub(super) group: Group,
    pub(super) depth: usize,
}

/// The tree of a group.
pub(super) struct Subtree {
    pub(super) nodes: Vec<WideNode>,
    /// The ids of its lights, in its order.
    pub(super) ids: Vec<u32>,
    /// Of all its lights.
    pub(super) moments: Moments,
}

impl PlacedGroup {
    pub(super) const fn count(&self) -> usize {
        self.group.sums.scan.count
    }

    /// Reads the lights and builds their tree; `power` is that of the lights of all groups.
    pub(super) fn build(self, options: &LightBvhOptions, power: f64) -> io::Result<Subtree> {
        let (ids, lights) = self.group.read()?;
        let (topology, order) = build(&lights, &self.group.sums.scan, options, self.depth);
        let mut nodes = topology.nodes();
        let moments = refit::fill(&mut nodes, 0, &order, &Lights::new(&lights, power));
        Ok(Subtree {
            nodes,
            ids: order.iter().map(|&k| ids[k as usize]).collect(),
            moments,
        })
    }
}
