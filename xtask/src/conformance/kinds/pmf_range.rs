use lights::bounds::{LightBounds, LightExtent, LightId, LightSampleContext};
use lights::bvh::reference::{Link, ReferenceLightBvhRef, Side};
use lights::math::glam::Vec3;
use lights::math::quantize::{MAX_COS, decode_cos};

use super::bounds::PreciseImportance;

/// What the vectors state: cosines are known to 3e-4 at worst, so importance to 5e-4 of itself without cosines.
const COS_ERROR: f64 = 5e-4;

/// How near to the bounding sphere, in radii, a point counts as on it.
const SPHERE_ERROR: f64 = 2e-6;

/// The values that a number can have, given how far the reference's cosines may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    pub(super) low: f64,
    pub(super) high: f64,
}

/// What a range allows for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Allowance {
    /// Round-off alone.
    RoundOff,
    /// Also that the cone of a node is one code wider than the reference's.
    WiderCones,
    /// Also both sides of the steps of the importance.
    Steps,
}

impl Range {
    /// One number alone.
    pub(super) const fn exactly(value: f64) -> Self {
        Self {
            low: value,
            high: value,
        }
    }

    /// The importances of `lb` at the point and normal around ours.
    fn of_importance(lb: &LightBounds, at: [Vec3; 2], allowance: Allowance) -> Self {
        let precise = PreciseImportance::new(lb, at[0], at[1]);
        let ctx = LightSampleContext::surface(at[0], at[1], at[1]);
        let ours = f64::from(lb.importance(&ctx));
        let error = COS_ERROR * precise.scale + 1e-5 * ours;
        let mut range = Self {
            low: (ours - error).max(0.0),
            high: ours + error,
        };
        if allowance == Allowance::Steps {
            let may_vanish = precise.emission_margin < COS_ERROR || lb.cos_theta_e == 1.0;
            let may_appear = precise.emission_margin.abs() < COS_ERROR;
            let on_sphere = precise.sphere_margin.abs() < SPHERE_ERROR;
            if may_vanish || on_sphere {
                range.low = 0.0;
            }
            if may_appear || on_sphere {
                range.high = range.high.max(precise.scale);
            }
        }
        range
    }

    /// The shares of `self` beside `other`.
    pub(super) fn share_beside(self, other: Self) -> Self {
        let share = |own: f64, other: f64| if own > 0.0 { own / (own + other) } else { 0.0 };
        Self {
            low: share(self.low, other.high),
            high: share(self.high, other.low),
        }
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            low: self.low + other.low,
            high: self.high + other.high,
        }
    }

    /// The smallest range that holds both.
    fn hull(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    pub(super) fn times(self, other: Self) -> Self {
        Self {
            low: self.low * other.low,
            high: self.high * other.high,
        }
    }

    /// Whether the reference's number lies within, up to round-off.
    pub(super) fn holds(self, theirs: f32) -> bool {
        let theirs = f64::from(theirs);
        self.low * (1.0 - 1e-5) - 1e-9 <= theirs && theirs <= self.high * (1.0 + 1e-5) + 1e-9
    }
}

/// What a query is about: point and normal, and what its answer allows for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Query {
    pub(super) at: [Vec3; 2],
    pub(super) allowance: Allowance,
}

impl Query {
    fn importance(&self, lb: &LightBounds) -> Range {
        Range::of_importance(lb, self.at, self.allowance)
    }

    fn node_importance(&self, tree: &ReferenceLightBvhRef<'_>, index: usize) -> Range {
        let decoded = decode(tree, index);
        let range = self.importance(&decoded);
        if self.allowance == Allowance::RoundOff {
            return range;
        }
        let code = (tree.nodes()[index].bounds().packed() & u32::from(MAX_COS)) as u16;
        range.hull(self.importance(&LightBounds {
            cos_theta_o: decode_cos(code + 1),
            ..decoded
        }))
    }

    /// The probabilities of `light` among `lights`, each in proportion to its importance.
    pub(super) fn pmf_among(&self, lights: &[LightExtent], light: LightId) -> Range {
        let ids = (0..).map(LightId).zip(lights);
        let mut own = Range::exactly(0.0);
        let mut others = Range::exactly(0.0);
        for (id, lb) in ids.filter_map(|(id, extent)| Some((id, extent.bounded()?))) {
            let sum = if id == light { &mut own } else { &mut others };
            *sum = sum.plus(self.importance(lb));
        }
        own.share_beside(others)
    }

    /// The probabilities of `light` in the tree.
    pub(super) fn pmf_in_tree(&self, tree: &ReferenceLightBvhRef<'_>, light: LightId) -> Range {
        let importance = |index: usize| self.node_importance(tree, index);
        if tree.nodes().len() == 1 {
            // A root that is a leaf is taken if it matters at all.
            let root = importance(0);
            return root.share_beside(Range::exactly(0.0));
        }
        let shares =
            forks(tree, light).map(|[own, other]| importance(own).share_beside(importance(other)));
        shares.fold(Range::exactly(1.0), Range::times)
    }

    /// Whether the reference divides 0 by 0 on the way to `light`, or takes the direction to a box centre from there.
    pub(super) fn explains_nan(&self, tree: &ReferenceLightBvhRef<'_>, light: LightId) -> bool {
        let is_dark = |index| self.node_importance(tree, index).low == 0.0;
        let is_centre = |index| decode(tree, index).bounds.center() == self.at[0];
        let on_the_way = |children: [usize; 2]| {
            children.iter().all(|&i| is_dark(i)) || children.iter().any(|&i| is_centre(i))
        };
        forks(tree, light).any(on_the_way) || (tree.nodes().len() == 1 && is_centre(0))
    }

    /// Whether the reference's sum over all `lights` is zero or has a light at whose box centre the point is.
    pub(super) fn explains_nan_among(&self, lights: &[LightExtent]) -> bool {
        let mut bounded = lights.iter().filter_map(LightExtent::bounded);
        bounded.clone().all(|lb| self.importance(lb).low == 0.0)
            || bounded.any(|lb| lb.bounds.center() == self.at[0])
    }
}

fn decode(tree: &ReferenceLightBvhRef<'_>, index: usize) -> LightBounds {
    tree.nodes()[index].bounds().decode(tree.bounds())
}

/// The nodes on the way to `light` below the root, each with its sibling.
fn forks(tree: &ReferenceLightBvhRef<'_>, light: LightId) -> impl Iterator<Item = [usize; 2]> {
    let mut index = 0;
    tree.trail(light).sides().map_while(move |side| {
        let Link::Interior { second_child } = tree.nodes()[index].link() else {
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
