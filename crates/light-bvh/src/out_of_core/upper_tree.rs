use alloc::vec::Vec;

use crate::node::wide_node::WideNode;

/// The tree over the groups: its nodes, whose lights are groups.
pub(super) struct UpperTree(pub(super) Vec<WideNode>);

impl UpperTree {
    /// Calls `each` with the place of each group in the order that the nodes refer to, and the
    /// number of levels above its tree, as they are written: what is in the first child of a node
    /// before what is in the second.
    pub(super) fn for_each_group(&self, each: &mut impl FnMut(usize, usize)) {
        match self.0.first() {
            Some(root) if self.is_one_group() => each(root.light_base as usize, 0),
            Some(root) => self.below(root, 1, each),
            None => {}
        }
    }

    /// Whether the tree of the only group takes the place of this one.
    pub(super) fn is_one_group(&self) -> bool {
        matches!(*self.0, [root] if root.count == 1)
    }

    fn below(&self, node: &WideNode, depth: usize, each: &mut impl FnMut(usize, usize)) {
        let (inner, count) = (usize::from(node.inner), node.children());
        for child in &self.0[node.child_base as usize..][..inner] {
            self.below(child, depth + 1, each);
        }
        for k in 0..count - inner {
            each(node.light_base as usize + k, depth);
        }
    }
}
