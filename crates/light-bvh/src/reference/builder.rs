use alloc::vec::Vec;

use light_bounds::light_math::Aabb;
use light_bounds::light_math::glam::Vec3;
use light_bounds::{CompactLightBounds, LightBounds, LightExtent, LightId};

use super::split::{Split, cheapest_split};
use super::{BitTrail, ReferenceNode};
use crate::parallel::join;
use crate::{LightBvhError, validate};

/// More lights would need more nodes than the links of a node can number.
const MAX_LIGHTS: usize = ReferenceNode::INDEX_LIMIT as usize / 2;

/// Whether the links of nodes can number so many lights and the nodes above them.
const fn is_addressable(lights: usize) -> bool {
    lights <= MAX_LIGHTS
}

/// A light on its way into the tree.
#[derive(Clone, Copy)]
struct Leaf {
    bounds: LightBounds,
    centroid: Vec3,
    light: LightId,
}

/// The nodes of the tree in depth-first order, and the box that they are relative to.
pub(super) fn build(lights: &[LightExtent]) -> Result<(Vec<ReferenceNode>, Aabb), LightBvhError> {
    let mut leaves = leaves(lights)?;
    let Some(first) = leaves.first() else {
        return Ok((Vec::new(), Aabb::EMPTY));
    };
    let all = leaves
        .iter()
        .map(|l| l.bounds.bounds)
        .fold(Aabb::EMPTY, Aabb::union);
    let blank = ReferenceNode::leaf(CompactLightBounds::encode(&first.bounds, &all), first.light);
    let mut nodes = alloc::vec![blank; 2 * leaves.len() - 1];
    Subtree {
        index: 0,
        depth: 0,
        all: &all,
    }
    .build(&mut leaves, &mut nodes);
    Ok((nodes, all))
}

/// The lights that the tree holds: somewhere, with power.
fn leaves(lights: &[LightExtent]) -> Result<Vec<Leaf>, LightBvhError> {
    if !is_addressable(lights.len()) {
        return Err(LightBvhError::TooManyLights { most: MAX_LIGHTS });
    }
    validate(lights)?;
    let bounded = (0..).map(LightId).zip(lights);
    let bounded = bounded.filter_map(|(light, extent)| Some((light, extent.bounded()?)));
    let leaf = |(light, bounds): (LightId, &LightBounds)| Leaf {
        bounds: *bounds,
        centroid: bounds.centroid(),
        light,
    };
    Ok(bounded.filter(|(_, b)| b.phi > 0.0).map(leaf).collect())
}

/// Where in the tree a group of lights goes.
#[derive(Clone, Copy)]
struct Subtree<'a> {
    /// Of its root among all nodes.
    index: u32,
    /// Of its root.
    depth: u32,
    all: &'a Aabb,
}

impl Subtree<'_> {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "there are fewer nodes than a link can number"
    )]
    /// Fills `nodes`, one less than twice the `lights`, and returns what bounds them. Recursive,
    /// never deeper than a trail.
    fn build(self, lights: &mut [Leaf], nodes: &mut [ReferenceNode]) -> LightBounds {
        let (root, nodes) = match nodes.split_first_mut() {
            Some(nodes) => nodes,
            None => return LightBounds::EMPTY,
        };
        if let [leaf] = lights {
            let compact = CompactLightBounds::encode(&leaf.bounds, self.all);
            *root = ReferenceNode::leaf(compact, leaf.light);
            return leaf.bounds;
        }

        let middle = self.divide(lights);
        let work = lights.len();
        let (first, second) = lights.split_at_mut(middle);
        let (first_nodes, second_nodes) = nodes.split_at_mut(2 * middle - 1);
        let first_tree = Self {
            index: self.index + 1,
            depth: self.depth + 1,
            all: self.all,
        };
        let second_tree = Self {
            index: first_tree.index + first_nodes.len() as u32,
            ..first_tree
        };
        let (a, b) = join(
            work,
            || first_tree.build(first, first_nodes),
            || second_tree.build(second, second_nodes),
        );
        let bounds = a.union(&b);
        let compact = CompactLightBounds::encode(&bounds, self.all);
        *root = ReferenceNode::interior(compact, second_tree.index);
        bounds
    }

    /// Brings the lights of the first child to the front and returns their number, at least one and
    /// not all.
    fn divide(self, lights: &mut [Leaf]) -> usize {
        let bounds = lights
            .iter()
            .map(|l| l.bounds.bounds)
            .fold(Aabb::EMPTY, Aabb::union);
        let centroids = Aabb::from_points(lights.iter().map(|l| l.centroid));
        let candidates = lights.iter().map(|l| (l.bounds, l.centroid));
        let Some(split) = cheapest_split(candidates, &bounds, &centroids) else {
            return lights.len() / 2;
        };
        let middle = partition(lights, &split);
        if self.fits(middle) && self.fits(lights.len() - middle) {
            return middle;
        }
        balance(lights, &centroids)
    }

    /// Whether a child's tree of that many lights can be kept within the depth of a trail.
    fn fits(self, lights: usize) -> bool {
        let levels = BitTrail::MAX_DEPTH - self.depth - 1;
        lights as u64 <= 1 << levels
    }
}

/// Moves the lights of the first side to the front and returns their number; exchanges from both
/// ends inward.
fn partition(lights: &mut [Leaf], split: &Split) -> usize {
    let is_first = |light: &Leaf| split.is_first(light.centroid);
    let (mut front, mut back) = (0, lights.len());
    loop {
        while front < back && is_first(&lights[front]) {
            front += 1;
        }
        while front < back && !is_first(&lights[back - 1]) {
            back -= 1;
        }
        if front == back {
            return front;
        }
        lights.swap(front, back - 1);
        front += 1;
        back -= 1;
    }
}

/// Moves the half of the lights that is lower along the widest axis to the front and returns its
/// number.
fn balance(lights: &mut [Leaf], centroids: &Aabb) -> usize {
    let axis = (0.5 * centroids.max - 0.5 * centroids.min).max_position();
    let middle = lights.len() / 2;
    lights.select_nth_unstable_by(middle, |a, b| {
        let order = a.centroid[axis].total_cmp(&b.centroid[axis]);
        order.then(a.light.cmp(&b.light))
    });
    middle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_of_the_largest_tree_fit() {
        let most = 1 << 30;
        // One leaf a light, and one node fewer above them.
        let last_node = 2 * most - 2;
        assert!(is_addressable(most), "so many");
        assert!(last_node < ReferenceNode::INDEX_LIMIT as usize, "a link");
        assert!(!is_addressable(most + 1), "one more");
    }
}
