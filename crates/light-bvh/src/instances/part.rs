use core::ops::Range;

use light_bounds::LightExtent;
use light_math::Aabb;

use crate::build::lights::Lights;
use crate::build::options::LightBvhOptions;
use crate::build::refit;
use crate::build::scan::Scan;
use crate::light_bvh::{LightBvh, saturated};
use crate::node::moments::Moments;
use crate::node::wide_node::{NOWHERE, WIDTH, WideNode};

/// Some lights of a prototype, which are a leaf of the upper tree wherever it is placed: one of the
/// trees of the prototype.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// Its nodes among those of the prototype, the root first.
    nodes: Range<usize>,
    /// Where its lights end in the order.
    order_end: usize,
    pub(crate) power: f32,
    /// Of its lights together; their power is a share of that of the part.
    pub(crate) moments: Moments,
}

impl Part {
    /// The tree of `lights`, of which `scan` holds the sums, behind the other trees of `all`.
    pub(crate) fn build(
        all: &mut LightBvh,
        lights: &[LightExtent],
        scan: &Scan,
        options: &LightBvhOptions,
    ) -> Self {
        let leaves = Lights::new(lights, scan.power);
        let (tree, moments) = LightBvh::build_of_leaves(lights, scan, options, &leaves);
        let first = all.nodes.len();
        append(all, tree);
        Self {
            nodes: first..all.nodes.len(),
            order_end: all.order.len(),
            power: saturated(scan.power),
            moments,
        }
    }

    /// Refits its tree to lights of so much power.
    pub(crate) fn refit(&mut self, all: &mut LightBvh, lights: &Lights<'_>, power: f64) {
        let nodes = &mut all.nodes[self.nodes.clone()];
        let order = &all.order[..self.order_end];
        self.moments = refit::fill(nodes, self.nodes.start, order, lights);
        self.power = saturated(power);
    }

    /// The root of its tree.
    #[inline(always)]
    pub(crate) const fn root(&self) -> usize {
        self.nodes.start
    }

    /// Whether the slot is one of its nodes.
    #[inline(always)]
    pub(crate) fn has(&self, slot: u32) -> bool {
        self.nodes.contains(&(slot as usize / WIDTH))
    }

    /// The boxes of the children of the root, which hold all lights that are on; `all` are the
    /// nodes of the prototype.
    pub(crate) fn child_boxes<'a>(&self, all: &'a [WideNode]) -> impl Iterator<Item = Aabb> + 'a {
        let root = all[self.nodes.clone()].first();
        root.into_iter()
            .flat_map(|root| root.lit_boxes().map(|(_, bounds)| bounds))
    }
}

/// Puts the nodes and lights of `tree` behind those of `all`, which counts the same lights.
#[expect(
    clippy::cast_possible_truncation,
    reason = "a prototype holds at most 2^28 lights, and no more nodes than lights"
)]
fn append(all: &mut LightBvh, tree: LightBvh) {
    let (nodes, lights) = (all.nodes.len() as u32, all.order.len() as u32);
    let slots = nodes * WIDTH as u32;
    let behind = |slot: u32| {
        if slot == NOWHERE {
            NOWHERE
        } else {
            slot + slots
        }
    };
    all.nodes
        .extend(tree.nodes.into_iter().map(|node| WideNode {
            child_base: node.child_base + nodes,
            light_base: node.light_base + lights,
            parent: behind(node.parent),
            ..node
        }));
    for &light in &tree.order {
        let light = light as usize;
        all.slots[light] = behind(tree.slots[light]);
    }
    all.order.extend(tree.order);
}
