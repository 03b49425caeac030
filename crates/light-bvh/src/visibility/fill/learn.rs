//! The nodes that a coarse cell copies, and the visible share of each child's lights.

use alloc::vec;
use alloc::vec::Vec;

use crate::node::wide_node::WIDTH;
use crate::query::bvh_ref::LightBvhRef;
use crate::visibility::cell_factors::{CopiedNode, MAX_COPIED_NODES, inner_child};
use crate::visibility::fill::counts::{Counts, NodeCounts};
use crate::visibility::fill::ray_log::{Ray, RayLog};

/// A copy of the top of a tree, and the visibility of each child.
#[derive(Clone, Debug)]
pub(super) struct Learnt {
    pub(super) shape: Vec<CopiedNode>,
    /// The expected visible share of each child's lights.
    pub(super) visibility: Vec<[f32; WIDTH]>,
}

/// A node that is copied, while nodes are opened.
struct Opened {
    index: u32,
    level: usize,
    counts: NodeCounts,
    /// The place of the copy of each child.
    copies: [Option<usize>; WIDTH],
}

/// Opens nodes, the best first: those of whose lights many are seen and some are not.
pub(super) fn learn(tree: &LightBvhRef<'_>, log: &RayLog) -> Learnt {
    let rays = log.rays();
    // The child of an opened node that each ray leads to: `16 * place + child`.
    let mut ends = vec![0; rays.len()];
    let mut opened = vec![open(rays, &mut ends, None, (0, 0, 0))];
    while opened.len() < MAX_COPIED_NODES {
        let Some((place, child, index)) = next_to_open(tree, &opened) else {
            break;
        };
        let copy = opened.len();
        let level = opened[place].level + 1;
        opened[place].copies[child] = Some(copy);
        let from = Some(WIDTH * place + child);
        opened.push(open(rays, &mut ends, from, (copy, level, index)));
    }
    in_order(&opened, &visibilities(&opened))
}

/// The node at `place`, to which the rays lead that ended at `from`; the root without it.
fn open(
    rays: &[Ray],
    ends: &mut [usize],
    from: Option<usize>,
    (place, level, index): (usize, usize, u32),
) -> Opened {
    let mut counts = NodeCounts::default();
    for (ray, end) in rays.iter().zip(ends) {
        if from.is_none_or(|from| from == *end) {
            let child = ray.child(level);
            counts[child].add(ray.is_seen());
            *end = WIDTH * place + child;
        }
    }
    Opened {
        index,
        level,
        counts,
        copies: [None; WIDTH],
    }
}

/// The closed child whose opening gains most, the first of equal ones: its node's place, its number
/// and its index in the tree.
fn next_to_open(tree: &LightBvhRef<'_>, opened: &[Opened]) -> Option<(usize, usize, u32)> {
    let mut best = (0, None);
    for (place, node) in opened.iter().enumerate() {
        let wide = tree.nodes().get(node.index as usize)?;
        for child in 0..usize::from(wide.inner).min(WIDTH) {
            let score = node.counts[child].open_score();
            if node.copies[child].is_none() && score > best.0 {
                if let Some(index) = inner_child(tree, node.index, wide, child) {
                    best = (score, Some((place, child, index)));
                }
            }
        }
    }
    best.1
}

/// The visibility of each child of each opened node, parents first.
fn visibilities(opened: &[Opened]) -> Vec<[f32; WIDTH]> {
    let mut of_all = Counts::default();
    for counts in opened[0].counts {
        of_all.rays += counts.rays;
        of_all.seen += counts.seen;
    }
    let mut visibilities = vec![[0.0; WIDTH]; opened.len()];
    let mut before = vec![of_all.visibility(0.5); opened.len()];
    for (place, node) in opened.iter().enumerate() {
        for (child, counts) in node.counts.iter().enumerate() {
            let visibility = counts.visibility(before[place]);
            visibilities[place][child] = visibility;
            if let Some(copy) = node.copies[child] {
                before[copy] = visibility;
            }
        }
    }
    visibilities
}

/// The opened nodes in the order of a [`CellFactors`](crate::visibility::CellFactors).
fn in_order(opened: &[Opened], visibility: &[[f32; WIDTH]]) -> Learnt {
    let mut order = vec![0];
    let mut learnt = Learnt {
        shape: Vec::with_capacity(opened.len()),
        visibility: Vec::with_capacity(opened.len()),
    };
    for next in 0..opened.len() {
        let place = order[next];
        let first = u16::try_from(order.len()).unwrap_or_default();
        let mut copied = CopiedNode { opened: 0, first };
        for (child, copy) in opened[place].copies.iter().enumerate() {
            if let Some(copy) = copy {
                copied.opened |= 1 << child;
                order.push(*copy);
            }
        }
        if copied.opened == 0 {
            copied.first = 0;
        }
        learnt.shape.push(copied);
        learnt.visibility.push(visibility[place]);
    }
    learnt
}
