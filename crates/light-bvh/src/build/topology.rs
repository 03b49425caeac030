use alloc::vec;
use alloc::vec::Vec;

use crate::node::wide_node::{NOWHERE, WIDTH, WideNode};
use crate::parallel::table;

/// How many children a node has.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NodeCounts {
    /// Those that are nodes; they come first.
    pub(crate) inner: u8,
    pub(crate) count: u8,
}

/// The shape of a subtree, without the data of its lights.
///
/// The root comes first, then the children of a node side by side, then what is below the first of
/// them, and so on.
#[derive(Debug)]
pub(crate) struct Topology(pub(crate) Vec<NodeCounts>);

impl Topology {
    /// A root above `subtrees`, which are its first children.
    pub(crate) fn join(root: NodeCounts, subtrees: &[Self]) -> Self {
        let roots = subtrees.iter().filter_map(|s| s.0.first());
        let mut all: Vec<NodeCounts> = core::iter::once(&root).chain(roots).copied().collect();
        for Self(counts) in subtrees {
            all.extend_from_slice(&counts[1..]);
        }
        Self(all)
    }

    /// Nodes that know their places and those of their lights.
    pub(crate) fn nodes(&self) -> Vec<WideNode> {
        let mut nodes = table(self.0.len(), |_| WideNode::EMPTY);
        self.place(|place| {
            let node = &mut nodes[place.index];
            (node.inner, node.count) = (place.counts.inner, place.counts.count);
            node.child_base = low_word(place.child_base);
            node.light_base = low_word(place.light_base);
            node.parent = place.parent;
        });
        nodes
    }

    /// The slot of each of `lights` lights, of which the tree holds those in `order`.
    pub(crate) fn slots(&self, order: &[u32], lights: usize) -> Vec<u32> {
        let mut slots = vec![NOWHERE; lights];
        self.place(|place| {
            let children = usize::from(place.counts.inner)..usize::from(place.counts.count);
            for (child, &light) in children.zip(&order[place.light_base..]) {
                slots[light as usize] = low_word(place.index * WIDTH + child);
            }
        });
        slots
    }

    /// Calls `each` with every node, parents before their children.
    fn place(&self, mut each: impl FnMut(&Place)) {
        if let Some(&counts) = self.0.first() {
            let root = Place {
                index: 0,
                counts,
                child_base: 1,
                light_base: 0,
                parent: NOWHERE,
            };
            self.place_below(root, &mut each);
        }
    }

    /// Returns the first free node and the first free position of a light after the subtree of
    /// `node`. Recursive, as deep as the tree at most.
    fn place_below(&self, node: Place, each: &mut impl FnMut(&Place)) -> (usize, usize) {
        each(&node);
        let inner = usize::from(node.counts.inner);
        let mut child_base = node.child_base + inner;
        let mut light_base = node.light_base + usize::from(node.counts.count) - inner;
        for child in 0..inner {
            let index = node.child_base + child;
            let child = Place {
                index,
                counts: self.0[index],
                child_base,
                light_base,
                parent: low_word(node.index * WIDTH + child),
            };
            (child_base, light_base) = self.place_below(child, each);
        }
        (child_base, light_base)
    }
}

/// Where a node and what belongs to it are.
struct Place {
    index: usize,
    counts: NodeCounts,
    /// The first of its children that are nodes.
    child_base: usize,
    /// The first of its lights in the order.
    light_base: usize,
    /// Slot of the node.
    parent: u32,
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "a tree holds fewer than 2^32 lights, and fewer nodes than lights"
)]
pub(crate) const fn low_word(x: usize) -> u32 {
    x as u32
}
