use light_bounds::LightGroups;

use crate::node::wide_node::{MAX_DEPTH, NOWHERE, WIDTH, WideNode};
use crate::query::bvh_ref::{LightBvhRef, groups_of_all};

/// Whether the nodes are one tree with parents before their children, and `order` and `slots` lead
/// from its leaves to the lights and back. Linear, without memory of its own.
pub(super) fn are_links_sound(tree: &LightBvhRef<'_>) -> bool {
    let (nodes, order, slots) = (tree.nodes(), tree.order(), tree.slots());
    let (mut children, mut lights) = (0, 0);
    for (index, node) in nodes.iter().enumerate() {
        if !has_sound_children(tree, index, node) || !is_near_root(nodes, index) {
            return false;
        }
        children += usize::from(node.inner);
        lights += node.children() - usize::from(node.inner);
    }
    // Each child names its parent and each light its place, so that none is counted twice.
    let placed = slots.iter().filter(|&&slot| slot != NOWHERE).count();
    let is_whole = children == nodes.len().saturating_sub(1);
    is_whole && lights == order.len() && placed == order.len()
}

/// Whether there are groups for all nodes or for none, and those of each node together are what its
/// parent has for it. The links are sound.
pub(super) fn are_groups_sound(tree: &LightBvhRef<'_>) -> bool {
    let (nodes, groups) = (tree.nodes(), tree.groups());
    let is_union = |(node, own): (&WideNode, &[LightGroups; WIDTH])| {
        let place = node.parent as usize;
        node.parent == NOWHERE || groups[place / WIDTH][place % WIDTH] == groups_of_all(own)
    };
    groups.is_empty() || groups.len() == nodes.len() && nodes.iter().zip(groups).all(is_union)
}

fn has_sound_children(tree: &LightBvhRef<'_>, index: usize, node: &WideNode) -> bool {
    let (inner, count) = (usize::from(node.inner), node.children());
    if inner > count || count > WIDTH {
        return false;
    }
    let place = |k: usize| WIDTH * index + k;
    let is_child = |k: usize| {
        let child = node.child_base as usize + k;
        let found = tree.nodes().get(child).map(|child| child.parent as usize);
        child > index && found == Some(place(k))
    };
    let is_light = |k: usize| {
        let entry = node.light_base as usize + k - inner;
        let light = tree.order().get(entry).map(|&light| light as usize);
        let slot = light.and_then(|light| tree.slots().get(light));
        slot.map(|&slot| slot as usize) == Some(place(k))
    };
    (0..inner).all(is_child) && (inner..count).all(is_light)
}

/// Whether the parents of node `index` lead to the root within the levels that a tree may have.
fn is_near_root(nodes: &[WideNode], index: usize) -> bool {
    let mut index = index;
    for _ in 0..MAX_DEPTH {
        if index == 0 {
            return nodes[0].parent == NOWHERE;
        }
        let parent = nodes[index].parent as usize / WIDTH;
        if parent >= index {
            return false;
        }
        index = parent;
    }
    false
}

#[cfg(test)]
mod tests {
    use core::array;

    use super::*;

    #[test]
    fn a_chain_of_more_nodes_than_a_tree_has_levels_does_not_end_at_the_root() {
        let node = |index: usize| WideNode {
            parent: index.checked_sub(1).map_or(NOWHERE, place_of_first_child),
            ..WideNode::EMPTY
        };
        let chain: [WideNode; MAX_DEPTH + 1] = array::from_fn(node);
        assert!(is_near_root(&chain, MAX_DEPTH - 1), "the deepest level");
        assert!(!is_near_root(&chain, MAX_DEPTH), "one level more");
        let own_parent = [node(0), node(2)];
        assert!(!is_near_root(&own_parent, 1), "no parent before it");
    }

    fn place_of_first_child(node: usize) -> u32 {
        u32::try_from(node * WIDTH).expect("few nodes")
    }
}
