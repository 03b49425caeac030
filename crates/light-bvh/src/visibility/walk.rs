//! Queries of a tree with the factors of a cell: a choice, and the probability of a light.

use light_bounds::SampledLight;
use light_math::float::positive_product;

use crate::importance::receiver::Receiver;
use crate::node::wide_node::{MAX_DEPTH, WideNode};
use crate::query::bvh_ref::{Child, LightBvhRef};
use crate::query::weights::Weights;
use crate::visibility::cell_factors::CellFactors;
use crate::visibility::multiply::multiply;
use crate::visibility::way::Way;

/// The weights of the children of a node, at `place` in the copy if it is there.
#[inline(always)]
fn weights<R: Receiver>(
    tree: &LightBvhRef<'_>,
    cell: &CellFactors<'_>,
    receiver: &R,
    (index, node): (usize, &WideNode),
    place: Option<usize>,
) -> Weights {
    let mut weights = tree.weights(index, node, receiver);
    if let Some(factors) = place.and_then(|place| cell.factors().get(place)) {
        multiply(&mut weights, factors);
    }
    weights
}

/// The weights of the root's children.
#[inline(always)]
pub(super) fn root<R: Receiver>(
    tree: &LightBvhRef<'_>,
    cell: &CellFactors<'_>,
    receiver: &R,
) -> Weights {
    match tree.nodes().first() {
        Some(root) => weights(tree, cell, receiver, (0, root), Some(0)),
        None => Weights::NONE,
    }
}

/// A light chosen by `u`, from the root whose weights are given.
#[inline(always)]
pub(super) fn descend<R: Receiver>(
    tree: &LightBvhRef<'_>,
    cell: &CellFactors<'_>,
    receiver: &R,
    root: &Weights,
    u: u64,
) -> Option<SampledLight> {
    let (mut index, mut place, mut pmf) = (0, 0, 1.0);
    let mut choice = root.choose(u)?;
    for _ in 0..MAX_DEPTH {
        let below = cell.below(place, choice.child);
        let (Some(below), Child::Node(child)) = (
            below,
            tree.child(tree.nodes().get(index as usize)?, choice.child),
        ) else {
            break;
        };
        pmf = positive_product(pmf, choice.probability);
        index = u32::try_from(child).ok()?;
        place = below;
        let node = (child, tree.nodes().get(child)?);
        choice = weights(tree, cell, receiver, node, Some(place)).choose(choice.u)?;
    }
    // Below the copy, or at a light.
    tree.descend_from(receiver, index, pmf, &choice)
}

/// The probability with which [`descend`] takes the path to a light: the same products.
#[inline(always)]
pub(super) fn pmf_along<R: Receiver>(
    tree: &LightBvhRef<'_>,
    cell: &CellFactors<'_>,
    receiver: &R,
    way: &Way,
    root: &Weights,
) -> f32 {
    let (mut pmf, mut place) = (1.0, Some(0));
    for (level, (index, child)) in way.down().enumerate() {
        let share = if level == 0 {
            root.probability(child)
        } else {
            let Some(node) = tree.nodes().get(index) else {
                return 0.0;
            };
            weights(tree, cell, receiver, (index, node), place).probability(child)
        };
        pmf = positive_product(pmf, share);
        place = place.and_then(|place| cell.below(place, child));
    }
    pmf
}
