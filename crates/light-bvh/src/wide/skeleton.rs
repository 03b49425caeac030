use alloc::vec;
use alloc::vec::Vec;

use super::build::low_word;
use super::node::{NOWHERE, WIDTH, WideNode};
use crate::join::table;

/// How many children a node has.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Fan {
    /// Those that are nodes; they come first.
    pub(super) inner: u8,
    pub(super) count: u8,
}

/// A subtree before its nodes know anything of their lights.
///
/// The root comes first, then the children of a node side by side, then what is below the first of them, and so on.
#[derive(Debug)]
pub(super) struct Skeleton(pub(super) Vec<Fan>);

impl Skeleton {
    /// A root above `subtrees`, which are its first children.
    pub(super) fn join(root: Fan, subtrees: &[Self]) -> Self {
        let roots = subtrees.iter().filter_map(|s| s.0.first());
        let mut all: Vec<Fan> = core::iter::once(&root).chain(roots).copied().collect();
        for Self(fans) in subtrees {
            all.extend_from_slice(&fans[1..]);
        }
        Self(all)
    }

    /// Nodes that know their places and those of their lights in `order`; and the slot of each of `lights` lights.
    pub(super) fn lay_out(&self, order: &[u32], lights: usize) -> (Vec<WideNode>, Vec<u32>) {
        let mut layout = Layout {
            fans: &self.0,
            nodes: table(self.0.len(), |_| WideNode::EMPTY),
            order,
            slots: vec![NOWHERE; lights],
            next_node: 1,
            next_light: 0,
        };
        if !self.0.is_empty() {
            layout.place(0, NOWHERE);
        }
        (layout.nodes, layout.slots)
    }
}

/// A tree whose nodes get their places, from the root down.
struct Layout<'a> {
    fans: &'a [Fan],
    nodes: Vec<WideNode>,
    order: &'a [u32],
    slots: Vec<u32>,
    /// The first node, and the first place in `order`, that are not taken yet.
    next_node: usize,
    next_light: usize,
}

impl Layout<'_> {
    /// Finds places for all that is below the node at `index`. Recursive, as deep as the tree at most.
    fn place(&mut self, index: usize, parent: u32) {
        let fan = self.fans[index];
        let (inner, count) = (usize::from(fan.inner), usize::from(fan.count));
        let child_base = self.next_node;
        let node = &mut self.nodes[index];
        (node.inner, node.count, node.parent) = (fan.inner, fan.count, parent);
        node.child_base = low_word(child_base);
        node.light_base = low_word(self.next_light);
        let lights = &self.order[self.next_light..][..count - inner];
        for (child, &light) in (inner..).zip(lights) {
            self.slots[light as usize] = low_word(index * WIDTH + child);
        }
        self.next_node += inner;
        self.next_light += lights.len();
        for child in 0..inner {
            self.place(child_base + child, low_word(index * WIDTH + child));
        }
    }
}
