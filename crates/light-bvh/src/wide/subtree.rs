use alloc::vec;
use alloc::vec::Vec;

use super::build::low_word;
use super::moments::Moments;
use super::node::{NOWHERE, WIDTH, WideNode};
use crate::join::map;

/// A part of the tree that does not know its place yet.
#[derive(Debug)]
pub(super) struct Subtree {
    nodes: Nodes,
    /// How many those are, the root too.
    count: usize,
    pub(super) moments: Moments,
}

#[derive(Debug)]
enum Nodes {
    /// In order, the root first; they refer to each other by their place here.
    Grown(Vec<WideNode>),
    /// A root above subtrees.
    Joined(WideNode, Vec<Subtree>),
}

impl Subtree {
    /// A whole subtree, the root first.
    pub(super) fn grown(nodes: Vec<WideNode>, moments: Moments) -> Self {
        Self {
            count: nodes.len(),
            nodes: Nodes::Grown(nodes),
            moments,
        }
    }

    /// A root above `subtrees`, which are its first children.
    pub(super) fn join(root: WideNode, moments: Moments, subtrees: Vec<Self>) -> Self {
        Self {
            count: 1 + subtrees.iter().map(|s| s.count).sum::<usize>(),
            nodes: Nodes::Joined(root, subtrees),
            moments,
        }
    }

    /// All nodes as one tree: the children of a node side by side, then what is below the first of them, and so on.
    pub(super) fn into_nodes(self) -> Vec<WideNode> {
        let mut nodes = vec![WideNode::EMPTY; self.count];
        if let Some((root, below)) = nodes.split_first_mut() {
            let place = Place {
                root,
                index: 0,
                parent: NOWHERE,
                below,
                base: 1,
            };
            place.put(self);
        }
        nodes
    }
}

/// Where a subtree goes.
struct Place<'n> {
    root: &'n mut WideNode,
    /// Of the root among all nodes.
    index: usize,
    /// Slot of the root.
    parent: u32,
    /// Room for the nodes below the root.
    below: &'n mut [WideNode],
    /// Of the first of them among all nodes.
    base: usize,
}

impl Place<'_> {
    fn put(self, subtree: Subtree) {
        match subtree.nodes {
            Nodes::Grown(nodes) => self.copy(&nodes),
            Nodes::Joined(root, subtrees) => {
                let inner = subtrees.len();
                *self.root = WideNode {
                    parent: self.parent,
                    child_base: low_word(self.base),
                    ..root
                };
                let (roots, mut below) = self.below.split_at_mut(inner);
                let mut base = self.base + inner;
                let mut jobs = Vec::with_capacity(inner);
                for ((slot, root), subtree) in roots.iter_mut().enumerate().zip(subtrees) {
                    let (mine, rest) = below.split_at_mut(subtree.count - 1);
                    let place = Place {
                        root,
                        index: self.base + slot,
                        parent: low_word(self.index * WIDTH + slot),
                        below: mine,
                        base,
                    };
                    (below, base) = (rest, base + subtree.count - 1);
                    jobs.push((place, subtree));
                }
                map(jobs, |(place, subtree)| place.put(subtree));
            }
        }
    }

    fn copy(self, nodes: &[WideNode]) {
        // Node 0 goes to the root's place, node 1 to the first place below.
        let moved = low_word(self.base).wrapping_sub(1);
        let node_of = |slot: u32| match slot as usize / WIDTH {
            0 => low_word(self.index),
            _ => (slot / 8).wrapping_add(moved),
        };
        for (node, to) in nodes
            .iter()
            .zip(core::iter::once(self.root).chain(self.below))
        {
            *to = WideNode {
                child_base: node.child_base.wrapping_add(moved),
                parent: match node.parent {
                    NOWHERE => self.parent,
                    slot => node_of(slot) * 8 + slot % 8,
                },
                ..*node
            };
        }
    }
}
