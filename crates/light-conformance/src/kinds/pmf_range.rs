//! The probabilities of lights by importance in double precision, as ranges of what rounding leaves
//! open.

use lights::bounds::{LightBounds, LightExtent, LightId};
use lights::bvh::reference::{Link, ReferenceLightBvhRef, Side};
use lights::math::glam::Vec3;
use std::cell::RefCell;

use super::bounds::Margins;
use crate::oracle::cone::importance;
use crate::oracle::parts::probability;
use crate::oracle::range;

/// In how many ways inputs are moved.
const WAYS: u32 = 48;

/// The relative error of an importance in single precision, and that of its cosines.
const RELATIVE: f64 = 4e-6;
const COS_ERROR: f64 = 4e-6;

/// The values that a number can have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Range {
    /// One number alone.
    pub(super) const fn exactly(value: f64) -> Self {
        Self {
            low: value,
            high: value,
        }
    }

    /// The importances of `lb` at the point and normal.
    pub(super) fn of_importance(lb: &LightBounds, at: [Vec3; 2]) -> Self {
        let scale = Margins::new(lb, at[0]).scale;
        let scale = if scale.is_finite() { scale } else { 0.0 };
        let [low, high] = range(WAYS, |jitter| importance(lb, at, jitter));
        let error = |x: f64| RELATIVE * x + COS_ERROR * scale;
        Self {
            low: if low > 0.0 {
                (low - error(low)).max(f64::from(f32::MIN_POSITIVE))
            } else {
                0.0
            },
            high: if high > 0.0 { high + error(high) } else { 0.0 },
        }
    }

    /// The shares of `self` beside `other`.
    pub(super) fn share_beside(self, other: Self) -> Self {
        // A light at the point itself outweighs all others.
        let share = |own: f64, other: f64| {
            if own == 0.0 {
                0.0
            } else {
                1.0 / (1.0 + other / own)
            }
        };
        if self.high.is_infinite() && other.high.is_infinite() {
            return Self {
                low: 0.0,
                high: 1.0,
            };
        }
        Self {
            low: share(self.low, other.high),
            high: share(self.high, other.low),
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            low: self.low + other.low,
            high: self.high + other.high,
        }
    }

    pub(super) fn times(self, other: Self) -> Self {
        Self {
            low: self.low * other.low,
            high: self.high * other.high,
        }
    }

    /// Whether a number lies within, up to round-off.
    pub(super) fn holds(self, x: f32) -> bool {
        let x = f64::from(x);
        self.low * (1.0 - 1e-5) - 1e-9 <= x && x <= self.high * (1.0 + 1e-5) + 1e-9
    }

    /// Whether it says little.
    pub(super) fn is_wide(self) -> bool {
        self.high > 1.5 * self.low + 1e-9
    }
}

/// The importances of all bounds for one query, computed when they are asked for.
pub(super) struct Importances<'a> {
    at: [Vec3; 2],
    lights: &'a [LightExtent],
    tree: ReferenceLightBvhRef<'a>,
    of_lights: RefCell<Vec<Option<Range>>>,
    of_nodes: RefCell<Vec<Option<Range>>>,
}

impl<'a> Importances<'a> {
    pub(super) fn new(
        at: [Vec3; 2],
        lights: &'a [LightExtent],
        tree: ReferenceLightBvhRef<'a>,
    ) -> Self {
        Self {
            at,
            lights,
            of_lights: RefCell::new(vec![None; lights.len()]),
            of_nodes: RefCell::new(vec![None; tree.nodes().len()]),
            tree,
        }
    }

    fn of_light(&self, index: usize) -> Range {
        let none = Range::exactly(0.0);
        let compute = || {
            let bounded = self.lights[index].bounded();
            bounded.map_or(none, |lb| Range::of_importance(lb, self.at))
        };
        *self.of_lights.borrow_mut()[index].get_or_insert_with(compute)
    }

    fn of_node(&self, index: usize) -> Range {
        let compute = || Range::of_importance(&self.decoded(index), self.at);
        *self.of_nodes.borrow_mut()[index].get_or_insert_with(compute)
    }

    fn decoded(&self, index: usize) -> LightBounds {
        self.tree.nodes()[index].bounds().decode(self.tree.bounds())
    }

    /// The probabilities of `light` among all, each in exact proportion to its importance.
    pub(super) fn proportion_among(&self, light: LightId) -> Range {
        let others = (0..self.lights.len()).filter(|&i| i != light.index());
        let others = others.map(|i| self.of_light(i));
        let others = others.fold(Range::exactly(0.0), Range::plus);
        self.of_light(light.index()).share_beside(others)
    }

    /// The probabilities of `light` among all, each in whole parts.
    pub(super) fn pmf_among(&self, light: LightId) -> Range {
        let all = (0..self.lights.len()).map(|i| self.of_light(i));
        let all: Vec<_> = all.map(|range| [range.low, range.high]).collect();
        let [low, high] = probability(&all, light.index());
        Range { low, high }
    }

    /// The probabilities of `light` in the tree.
    pub(super) fn pmf_in_tree(&self, light: LightId) -> Range {
        if self.tree.nodes().len() == 1 {
            // A root that is a leaf is taken if it matters at all.
            return self.of_node(0).share_beside(Range::exactly(0.0));
        }
        let shares = self
            .forks(light)
            .map(|[own, other]| self.of_node(own).share_beside(self.of_node(other)));
        shares.fold(Range::exactly(1.0), Range::times)
    }

    /// The lights that `u` of the tree's share may choose, -1 for none.
    pub(super) fn choices_in_tree(&self, u: f64) -> Vec<i64> {
        let mut choices = Vec::new();
        let root = self.of_node(0);
        if root.low == 0.0 && self.tree.nodes().len() == 1 {
            choices.push(-1);
        }
        self.collect(0, [u, u], &mut choices);
        choices
    }

    fn collect(&self, index: usize, [low, high]: [f64; 2], choices: &mut Vec<i64>) {
        let second = match self.tree.nodes()[index].link() {
            Link::Leaf(light) => return choices.push(i64::from(light.0)),
            Link::Interior { second_child } => second_child as usize,
        };
        let (a, b) = (self.of_node(index + 1), self.of_node(second));
        if a.low == 0.0 && b.low == 0.0 {
            choices.push(-1);
        }
        // What a choice leaves of u is rounded as well.
        const ROUNDING: f64 = 1e-7;
        let share = a.share_beside(b);
        let (low, high) = (low - ROUNDING, high + ROUNDING);
        if low < share.high && a.high > 0.0 {
            let remap = |u: f64, share: f64| (u / share).clamp(0.0, 1.0);
            let u = [remap(low, share.high), remap(high, share.low.max(1e-300))];
            self.collect(index + 1, u, choices);
        }
        if high >= share.low && b.high > 0.0 {
            let remap =
                |u: f64, share: f64| ((u - share) / (1.0 - share).max(1e-300)).clamp(0.0, 1.0);
            let u = [remap(low, share.high), remap(high, share.low)];
            self.collect(second, u, choices);
        }
    }

    /// The nodes on the way to `light` below the root, each with its sibling.
    fn forks(&self, light: LightId) -> impl Iterator<Item = [usize; 2]> {
        let mut index = 0;
        self.tree.trail(light).sides().map_while(move |side| {
            let Link::Interior { second_child } = self.tree.nodes()[index].link() else {
                return None;
            };
            let children = [index + 1, second_child as usize];
            let [own, other] = match side {
                Side::First => children,
                Side::Second => [children[1], children[0]],
            };
            index = own;
            Some([own, other])
        })
    }
}
