use alloc::vec::Vec;
use core::ops::RangeInclusive;

use light_math::Aabb;
use light_math::glam::Vec3;

use crate::build::bins::{Grid, Plane};
use crate::build::cluster::{Prim, Sums};
use crate::build::light_primitive::Lamp;
use crate::build::split_group::Group;
use crate::build::subtree::{Crowd, Plot};
use crate::build::topology::Skeleton;
use crate::node::wide_node::WIDTH;

/// Runs of so many are split across their widest axis, the first part as large as a node, so that the lowest nodes come out full.
const SNAP: RangeInclusive<usize> = WIDTH + 1..=2 * WIDTH;

/// Lights, or clusters of a few, that are split where the halves cost least.
#[derive(Debug)]
pub(crate) struct Run<'a> {
    prims: &'a mut [Prim],
    lamps: &'a [Lamp],
    /// Of all prims together.
    lights: usize,
    /// Box of the centres.
    bounds: Aabb,
    cost: f32,
    /// Prims before the first narrow one, in the order of the curve; 0 if all are of one kind.
    wide: usize,
}

impl<'a> Run<'a> {
    /// The lights of `prims`, which are in the order of the curve or of one kind.
    pub(crate) fn new(prims: &'a mut [Prim], lamps: &'a [Lamp]) -> Self {
        Self {
            bounds: centers(prims),
            lights: prims.iter().map(|p| p.lights as usize).sum(),
            wide: prims.partition_point(|p| !p.is_narrow()),
            prims,
            lamps,
            cost: f32::INFINITY,
        }
    }

    /// The two parts on either side of prim `middle`.
    fn split_at(self, middle: usize, bounds: [Aabb; 2], costs: [f32; 2]) -> (Self, Self) {
        let only_lights = self.prims.len() == self.lights;
        let (left, right) = self.prims.split_at_mut(middle);
        let left_lights = if only_lights {
            middle
        } else {
            left.iter().map(|p| p.lights as usize).sum()
        };
        let part = |prims, lights, side: usize| Self {
            prims,
            lamps: self.lamps,
            lights,
            bounds: bounds[side],
            cost: costs[side],
            wide: 0,
        };
        (
            part(left, left_lights, 0),
            part(right, self.lights - left_lights, 1),
        )
    }

    /// Two parts of a few across the widest axis, the first as large as a node.
    fn split_few(self) -> (Self, Self) {
        let axis = self.bounds.diagonal().max_position();
        let mut keys = [u64::MAX; *SNAP.end()];
        for (key, prim) in keys.iter_mut().zip(&*self.prims) {
            *key = key_along(prim, axis);
        }
        let (_, &mut first_right, _) = keys.select_nth_unstable(WIDTH);
        let is_left = |p: &Prim| key_along(p, axis) < first_right;
        let (middle, bounds) = partition(self.prims, is_left);
        let (left, right) = self.prims.split_at(middle);
        let costs = [cost(left, bounds[0].min), cost(right, bounds[1].min)];
        self.split_at(middle, bounds, costs)
    }

    /// The cheapest plane across an axis.
    fn best_plane(&self, grid: &Grid) -> Option<(usize, Plane)> {
        let bins = grid.sums_by_position(self.prims);
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

impl Group for Run<'_> {
    fn lights(&self) -> usize {
        self.lights
    }

    fn is_divisible(&self) -> bool {
        self.prims.len() > 1
    }

    fn price(&self) -> f32 {
        self.cost
    }

    fn split(self) -> (Self, Self) {
        if (1..self.prims.len()).contains(&self.wide) {
            let (wide, narrow) = self.prims.split_at(self.wide);
            let bounds = [centers(wide), centers(narrow)];
            let costs = [cost(wide, bounds[0].min), cost(narrow, bounds[1].min)];
            let middle = self.wide;
            return self.split_at(middle, bounds, costs);
        }
        if SNAP.contains(&self.prims.len()) {
            return self.split_few();
        }
        let grid = Grid::new(&self.bounds);
        let Some((axis, plane)) = self.best_plane(&grid) else {
            // Nothing tells them apart: centres in one point, or too close to each other.
            let costs = [self.cost / 2.0; 2];
            let (middle, bounds) = (self.prims.len() / 2, [self.bounds; 2]);
            return self.split_at(middle, bounds, costs);
        };
        let (middle, bounds) = partition(self.prims, |p| grid.along(p, axis) <= plane.bin);
        self.split_at(middle, bounds, plane.costs)
    }

    fn halve(self) -> (Self, Self) {
        let axis = self.bounds.diagonal().max_position();
        let middle = self.prims.len() / 2;
        self.prims
            .select_nth_unstable_by_key(middle, |p| key_along(p, axis));
        let (left, right) = self.prims.split_at(middle);
        let bounds = [centers(left), centers(right)];
        let costs = [cost(left, bounds[0].min), cost(right, bounds[1].min)];
        self.split_at(middle, bounds, costs)
    }

    fn each_light(&self, each: impl FnMut(u32)) {
        let lamps = self.prims.iter().flat_map(|p| of_prim(self.lamps, p));
        lamps.map(|lamp| lamp.light).for_each(each);
    }
}

impl Crowd for Run<'_> {
    const PLOT: usize = 256;

    /// From here on lights are split one by one.
    fn plant(self, plot: Plot<'_>) -> Skeleton {
        let lamps = self.lamps;
        let mut prims = Vec::with_capacity(self.lights);
        for prim in &*self.prims {
            let lights = (prim.first..).zip(of_prim(lamps, prim));
            prims.extend(lights.map(|(place, lamp)| Prim::of_lamp(lamp, place)));
        }
        plot.grow(Run::new(&mut prims, lamps))
    }
}

fn of_prim<'a>(lamps: &'a [Lamp], prim: &Prim) -> &'a [Lamp] {
    &lamps[prim.first as usize..][..prim.lights as usize]
}

/// Numbers in the order of the centres along `axis`; of the places on the curve where they agree.
fn key_along(prim: &Prim, axis: usize) -> u64 {
    let bits = prim.center[axis].to_bits();
    let is_negative = bits >> 31 == 1;
    let ascending = bits ^ if is_negative { !0 } else { 1 << 31 };
    u64::from(ascending) << 32 | u64::from(prim.first)
}

/// The cost of a group; `near` is a point near it.
fn cost(prims: &[Prim], near: Vec3) -> f32 {
    let sums = prims.iter().map(|p| Sums::of(p, p.center - near));
    sums.fold(Sums::default(), |all, s| all.plus(&s)).cost()
}

/// The box of the centres.
fn centers(prims: &[Prim]) -> Aabb {
    prims.iter().fold(Aabb::EMPTY, |b, p| b.extend(p.center))
}

/// Moves what is `left` to the front, and returns how many those are, and the boxes of both sides.
fn partition(prims: &mut [Prim], left: impl Fn(&Prim) -> bool) -> (usize, [Aabb; 2]) {
    let mut bounds = [Aabb::EMPTY; 2];
    let (mut middle, mut end) = (0, prims.len());
    while middle < end {
        let prim = &prims[middle];
        if left(prim) {
            bounds[0] = bounds[0].extend(prim.center);
            middle += 1;
        } else {
            bounds[1] = bounds[1].extend(prim.center);
            end -= 1;
            prims.swap(middle, end);
        }
    }
    (middle, bounds)
}
