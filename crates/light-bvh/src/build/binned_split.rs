use alloc::vec::Vec;
use core::ops::RangeInclusive;

use light_math::Aabb;
use light_math::glam::Vec3;

use crate::build::bins::{Grid, Plane, is_in_few_places};
use crate::build::cluster::{Cluster, Sums};
use crate::build::dominant::Dominant;
use crate::build::light_primitive::LightPrimitive;
use crate::build::split_group::SplitGroup;
use crate::build::subtree::{OutputSlice, ParallelGroup};
use crate::build::topology::Topology;
use crate::node::wide_node::WIDTH;

/// Groups of these sizes are split across their widest axis, the first part as large as a node, so
/// that the lowest nodes are full.
const SNAP: RangeInclusive<usize> = WIDTH + 1..=2 * WIDTH;

/// How much less the rest of a group of these sizes costs where one light is split from it.
const SNAP_SAVING: f32 = 0.5;

/// A group of lights, or of clusters of a few, that is split where the halves cost least.
#[derive(Debug)]
pub(crate) struct BinnedSplit<'a> {
    clusters: &'a mut [Cluster],
    primitives: &'a [LightPrimitive],
    /// Of all clusters together.
    lights: usize,
    /// Box of the centres.
    bounds: Aabb,
    cost: f32,
}

impl<'a> BinnedSplit<'a> {
    /// The lights of `clusters`.
    pub(crate) fn new(clusters: &'a mut [Cluster], primitives: &'a [LightPrimitive]) -> Self {
        Self {
            bounds: centers(clusters),
            lights: clusters.iter().map(|p| p.lights as usize).sum(),
            clusters,
            primitives,
            cost: f32::INFINITY,
        }
    }

    /// The two parts on either side of cluster `middle`.
    fn split_at(self, middle: usize, bounds: [Aabb; 2], costs: [f32; 2]) -> (Self, Self) {
        let only_lights = self.clusters.len() == self.lights;
        let (left, right) = self.clusters.split_at_mut(middle);
        let left_lights = if only_lights {
            middle
        } else {
            left.iter().map(|p| p.lights as usize).sum()
        };
        let part = |clusters, lights, side: usize| Self {
            clusters,
            primitives: self.primitives,
            lights,
            bounds: bounds[side],
            cost: costs[side],
        };
        (
            part(left, left_lights, 0),
            part(right, self.lights - left_lights, 1),
        )
    }

    /// Cluster `place` alone, and the others.
    fn split_off(self, place: usize, rest_cost: f32) -> (Self, Self) {
        self.clusters.swap(0, place);
        let (one, rest) = self.clusters.split_at(1);
        let bounds = [centers(one), centers(rest)];
        let costs = [cost(one, bounds[0].min), rest_cost];
        self.split_at(1, bounds, costs)
    }

    /// Two parts of a few across the widest axis, the first as large as a node.
    fn split_few(self) -> (Self, Self) {
        let axis = self.bounds.diagonal().max_position();
        let mut keys = [u64::MAX; *SNAP.end()];
        for (key, cluster) in keys.iter_mut().zip(&*self.clusters) {
            *key = key_along(cluster, axis);
        }
        let (_, &mut first_right, _) = keys.select_nth_unstable(WIDTH);
        let is_left = |p: &Cluster| key_along(p, axis) < first_right;
        let (middle, bounds) = partition(self.clusters, is_left);
        let (left, right) = self.clusters.split_at(middle);
        let costs = [cost(left, bounds[0].min), cost(right, bounds[1].min)];
        self.split_at(middle, bounds, costs)
    }

    /// The cheapest plane across an axis.
    fn best_plane(&self, grid: &Grid) -> Option<(usize, Plane)> {
        let bins = grid.sums_by_position(self.clusters);
        let mut best: Option<(usize, Plane)> = None;
        for axis in grid.axes() {
            if let Some(plane) = bins[axis].best_plane() {
                if best.is_none_or(|(_, best)| plane.cost() < best.cost()) {
                    best = Some((axis, plane));
                }
            }
        }
        best
    }
}

impl SplitGroup for BinnedSplit<'_> {
    fn lights(&self) -> usize {
        self.lights
    }

    fn is_divisible(&self) -> bool {
        self.clusters.len() > 1
    }

    fn size(&self) -> f32 {
        self.bounds.diagonal().max_element()
    }

    fn power(&self) -> f32 {
        self.clusters.iter().map(|p| p.power).sum()
    }

    fn cost(&self) -> f32 {
        self.cost
    }

    fn split(self) -> (Self, Self) {
        let dominant = Dominant::of(self.clusters, self.bounds.min);
        let off = |most| dominant.as_ref().filter(|one| one.rest_cost < most);
        if SNAP.contains(&self.clusters.len()) && !is_in_few_places(self.clusters, &self.bounds) {
            return match off(SNAP_SAVING * self.cost) {
                Some(one) => self.split_off(one.place, one.rest_cost),
                None => self.split_few(),
            };
        }
        let grid = Grid::new(&self.bounds);
        let Some((axis, plane)) = self.best_plane(&grid) else {
            // No plane separates them: all centres are in one point, or too close to each other.
            let costs = [self.cost / 2.0; 2];
            let (middle, bounds) = (self.clusters.len() / 2, [self.bounds; 2]);
            return self.split_at(middle, bounds, costs);
        };
        if let Some(one) = off(plane.cost()) {
            return self.split_off(one.place, one.rest_cost);
        }
        let (middle, bounds) = partition(self.clusters, |p| grid.along(p, axis) <= plane.bin);
        self.split_at(middle, bounds, plane.costs)
    }

    fn halve(self) -> (Self, Self) {
        let axis = self.bounds.diagonal().max_position();
        let middle = self.clusters.len() / 2;
        self.clusters
            .select_nth_unstable_by_key(middle, |p| key_along(p, axis));
        let (left, right) = self.clusters.split_at(middle);
        let bounds = [centers(left), centers(right)];
        let costs = [cost(left, bounds[0].min), cost(right, bounds[1].min)];
        self.split_at(middle, bounds, costs)
    }

    fn each_light(&self, each: impl FnMut(u32)) {
        let primitives = self
            .clusters
            .iter()
            .flat_map(|p| primitives_of(self.primitives, p));
        primitives.map(|primitive| primitive.light).for_each(each);
    }
}

impl ParallelGroup for BinnedSplit<'_> {
    const MAX_SERIAL_LIGHTS: usize = 256;

    /// Below this size lights are split one by one, not by clusters.
    fn build_subtree(self, output: OutputSlice<'_>) -> Topology {
        let primitives = self.primitives;
        let mut clusters = Vec::with_capacity(self.lights);
        for cluster in &*self.clusters {
            let lights = (cluster.first..).zip(primitives_of(primitives, cluster));
            clusters
                .extend(lights.map(|(place, primitive)| Cluster::of_primitive(primitive, place)));
        }
        output.build_serial(BinnedSplit::new(&mut clusters, primitives))
    }
}

fn primitives_of<'a>(primitives: &'a [LightPrimitive], cluster: &Cluster) -> &'a [LightPrimitive] {
    &primitives[cluster.first as usize..][..cluster.lights as usize]
}

/// A key in the order of the centres along `axis`; equal centres are in the order of the curve.
fn key_along(cluster: &Cluster, axis: usize) -> u64 {
    let bits = cluster.center[axis].to_bits();
    let is_negative = bits >> 31 == 1;
    let ascending = bits ^ if is_negative { !0 } else { 1 << 31 };
    u64::from(ascending) << 32 | u64::from(cluster.first)
}

/// The cost of a group; `near` is a point near it.
fn cost(clusters: &[Cluster], near: Vec3) -> f32 {
    let sums = clusters.iter().map(|p| Sums::of(p, p.center - near));
    sums.fold(Sums::default(), |all, s| all.plus(&s)).cost()
}

/// The box of the centres.
fn centers(clusters: &[Cluster]) -> Aabb {
    clusters.iter().fold(Aabb::EMPTY, |b, p| b.extend(p.center))
}

/// Moves what is `left` to the front, and returns how many those are, and the boxes of both sides.
fn partition(clusters: &mut [Cluster], left: impl Fn(&Cluster) -> bool) -> (usize, [Aabb; 2]) {
    let mut bounds = [Aabb::EMPTY; 2];
    let (mut middle, mut end) = (0, clusters.len());
    while middle < end {
        let cluster = &clusters[middle];
        if left(cluster) {
            bounds[0] = bounds[0].extend(cluster.center);
            middle += 1;
        } else {
            bounds[1] = bounds[1].extend(cluster.center);
            end -= 1;
            clusters.swap(middle, end);
        }
    }
    (middle, bounds)
}

#[cfg(test)]
mod tests {
    use light_bounds::{LightBounds, LightExtent};

    use super::*;
    use crate::LightBvh;

    #[test]
    fn keys_are_in_the_order_of_the_centres() {
        let key = |x: f32, first| {
            let cluster = Cluster {
                center: Vec3::Y * x,
                first,
                ..Cluster::NOTHING
            };
            key_along(&cluster, 1)
        };
        let centres = [-1e30f32, -2.0, -1.5, -1e-40, 0.0, 1e-40, 0.5, 3.0, 1e30];
        let keys = centres.map(|x| key(x, 7));
        assert!(keys.is_sorted_by(|a, b| a < b), "{keys:x?}");
        assert!(key(1.0, 1) < key(1.0, 2), "the order of the curve");
    }

    #[test]
    fn rooms_far_from_each_other_are_not_in_one_node() {
        let rooms: Vec<_> = (0..20u16)
            .map(|i| {
                let p = Vec3::new(f32::from(i), f32::from(i % 7), 0.0);
                LightExtent::Bounded(LightBounds {
                    bounds: Aabb::from_point(p + f32::from(i / 10) * 1e5 * Vec3::Y),
                    w: Vec3::Z,
                    phi: 1.0,
                    cos_theta_o: -1.0,
                    cos_theta_e: 0.0,
                    two_sided: false,
                })
            })
            .collect();
        let tree = LightBvh::build(&rooms).expect("valid lights");
        let counts: Vec<_> = tree.nodes.iter().map(|n| (n.children(), n.inner)).collect();
        assert_eq!(counts, [(2, 2), (10, 0), (10, 0)]);
    }
}
