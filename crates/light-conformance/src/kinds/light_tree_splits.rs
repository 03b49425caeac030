//! The splits of a light hierarchy, held to the published cost in double precision.

use lights::bounds::{LightBounds, LightExtent};
use lights::bvh::reference::{Link, ReferenceLightBvhRef};
use lights::math::Aabb;
use std::f64::consts::{FRAC_PI_2, PI};

use crate::oracle::Jitter;
use crate::oracle::cone::ExactCone;

const BUCKETS: usize = 12;

/// What single precision moves the emission of a side by: its formula, and the angle of a cone that
/// unions have widened.
const MEASURE_ERROR: f64 = 1e-5;
const COS_ERROR: f64 = 4.0 * f32::EPSILON as f64;

/// Whether every split of the tree is the cheapest one, or as cheap up to rounding; if not, which
/// one is not.
pub(super) fn check(tree: &ReferenceLightBvhRef<'_>, lights: &[LightExtent]) -> Result<(), String> {
    let has_power = |i: &usize| lights[*i].bounded().is_some_and(|lb| lb.phi > 0.0);
    let mut order: Vec<_> = (0..lights.len()).filter(has_power).collect();
    check_node(tree, lights, 0, &mut order)
}

fn check_node(
    tree: &ReferenceLightBvhRef<'_>,
    lights: &[LightExtent],
    index: usize,
    order: &mut [usize],
) -> Result<(), String> {
    let second = match tree.nodes()[index].link() {
        Link::Leaf(light) if *order == [light.index()] => return Ok(()),
        Link::Leaf(light) => return Err(format!("leaf {light:?} for {order:?}")),
        Link::Interior { second_child } => second_child as usize,
    };
    // A subtree of n lights has 2 n - 1 nodes, one after the other.
    let first = &tree.nodes()[index + 1..second];
    let is_first = |light: usize| {
        let is_light = |link| matches!(link, Link::Leaf(id) if id.index() == light);
        first.iter().any(|node| is_light(node.link()))
    };
    let ours: Vec<_> = order.iter().map(|&light| is_first(light)).collect();
    let middle = ours.iter().filter(|&&is_first| is_first).count();
    let group: Vec<_> = order.iter().filter_map(|&i| lights[i].bounded()).collect();
    let splits = splits(&group);
    let least = splits.iter().map(|s| s.cost + s.error);
    let least = least.fold(f64::INFINITY, f64::min);
    // Two lights that cost nothing stay in their order, as all at one place do.
    let in_order: Vec<_> = (0..order.len()).map(|i| i < order.len() / 2).collect();
    let is_kept = splits.is_empty() || (order.len() == 2 && least == 0.0);
    let is_cheapest = splits
        .iter()
        .any(|s| s.is_first == ours && s.cost - s.error <= least);
    if !(is_cheapest || (is_kept && ours == in_order)) {
        return Err(format!("node {index} is not split where it costs least"));
    }
    exchange(order, is_first);
    let (a, b) = order.split_at_mut(middle);
    check_node(tree, lights, index + 1, a)?;
    check_node(tree, lights, second, b)
}

/// Moves the lights of the first side to the front by exchanges from both ends, as the published
/// partition does.
fn exchange(order: &mut [usize], is_first: impl Fn(usize) -> bool) {
    let (mut front, mut back) = (0, order.len());
    while front < back {
        if is_first(order[front]) {
            front += 1;
        } else if !is_first(order[back - 1]) {
            back -= 1;
        } else {
            order.swap(front, back - 1);
        }
    }
}

/// Which lights go first, what that costs, and by how much rounding moves the cost.
struct Split {
    is_first: Vec<bool>,
    cost: f64,
    error: f64,
}

fn splits(group: &[&LightBounds]) -> Vec<Split> {
    let boxes = group.iter().map(|lb| lb.bounds);
    let node = boxes.fold(Aabb::EMPTY, Aabb::union);
    let centroids = Aabb::from_points(group.iter().map(|lb| lb.centroid()));
    let mut splits = Vec::new();
    for axis in 0..3 {
        let [low, high] = [centroids.min[axis], centroids.max[axis]];
        if low >= high {
            continue;
        }
        // In single precision: a centroid on the edge of two buckets is in either.
        let bucket = |lb: &&LightBounds| {
            let offset = (lb.centroid()[axis] - low) / (high - low);
            ((BUCKETS as f32 * offset) as usize).min(BUCKETS - 1)
        };
        let buckets: Vec<_> = group.iter().map(bucket).collect();
        for end in 1..BUCKETS - 1 {
            let side = |range: std::ops::RangeInclusive<usize>| {
                let in_bucket = |bucket: usize| {
                    let members = group.iter().zip(&buckets);
                    let members = members.filter(move |&(_, &b)| b == bucket);
                    members.map(|(lb, _)| Side::of(lb)).reduce(Side::union)
                };
                range.filter_map(in_bucket).reduce(Side::union)
            };
            let (Some(a), Some(b)) = (side(0..=end), side(end + 1..=BUCKETS - 1)) else {
                continue;
            };
            let [a, b] = [a, b].map(|side| side.cost(&node, axis));
            splits.push(Split {
                is_first: buckets.iter().map(|&b| b <= end).collect(),
                cost: a[0] + b[0],
                error: a[1] + b[1],
            });
        }
    }
    splits
}

/// The lights of one side.
#[derive(Clone, Copy)]
struct Side {
    bounds: Aabb,
    phi: f64,
    cone: ExactCone,
    cos_theta_e: f64,
}

impl Side {
    fn of(lb: &LightBounds) -> Self {
        Self {
            bounds: lb.bounds,
            phi: f64::from(lb.phi),
            cone: ExactCone::new(lb.w, lb.cos_theta_o),
            cos_theta_e: f64::from(lb.cos_theta_e),
        }
    }

    fn union(self, other: Self) -> Self {
        Self {
            bounds: self.bounds.union(other.bounds),
            phi: self.phi + other.phi,
            cone: self.cone.union(other.cone, &mut Jitter::default()),
            cos_theta_e: self.cos_theta_e.min(other.cos_theta_e),
        }
    }

    /// Power times emission times size, and the error of that.
    fn cost(&self, node: &Aabb, axis: usize) -> [f64; 2] {
        let extents = |b: &Aabb| (b.max.as_dvec3() - b.min.as_dvec3()).to_array();
        let area = |[x, y, z]: [f64; 3]| x * y + y * z + z * x;
        let longest = |e: [f64; 3]| e.into_iter().fold(0.0, f64::max);
        let (all, own) = (extents(node), extents(&self.bounds));
        // Lights on a line cost by their length.
        let size = if area(all) > 0.0 {
            area(own)
        } else {
            longest(own)
        };
        let cos_o = self.cone.cos_theta.clamp(-1.0, 1.0);
        let (theta_o, theta_e) = (cos_o.acos(), self.cos_theta_e.clamp(-1.0, 1.0).acos());
        let theta_w = (theta_o + theta_e).min(PI);
        let sin_o = theta_o.sin();
        let beyond = 2.0 * (theta_w - theta_o) * sin_o - (theta_o - 2.0 * theta_w).cos() + cos_o;
        let measure = 2.0 * PI * (1.0 - cos_o) + FRAC_PI_2 * beyond;
        // The angle of a narrow cone has half of the digits of its cosine; emission grows by at
        // most 5 a radian.
        let is_narrow = cos_o > 0.0 && cos_o < 1.0;
        let angle_error = if is_narrow {
            COS_ERROR / sin_o.max(COS_ERROR.sqrt())
        } else {
            0.0
        };
        let scale = self.phi * longest(all) / all[axis] * size;
        [scale * measure, scale * (MEASURE_ERROR + 5.0 * angle_error)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lights::math::glam::Vec3;

    fn lamp(x: f32, y: f32) -> LightBounds {
        LightBounds {
            bounds: Aabb::new(Vec3::new(x, y, 0.0), Vec3::new(x + 1.0, y + 1.0, 1.0)),
            w: Vec3::Z,
            phi: 1.0,
            cos_theta_o: 1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        }
    }

    #[test]
    fn two_clusters_cost_least_apart_and_equal_axes_cost_the_same() {
        let row = [lamp(0.0, 0.0), lamp(1.0, 0.0), lamp(9.0, 0.0)];
        let splits_of_row = splits(&row.each_ref());
        let apart = |s: &&Split| s.is_first == [true, true, false];
        let cost = splits_of_row.iter().find(apart).expect("a split").cost;
        // Flat lamps emit pi; half areas are 5 and 3 of a box with extents 10, 1 and 1.
        assert!((cost - (2.0 * 5.0 + 3.0) * PI).abs() < 1e-12, "{cost}");

        let diagonal = [lamp(0.0, 4.0), lamp(4.0, 0.0)];
        let costs: Vec<_> = splits(&diagonal.each_ref())
            .iter()
            .map(|s| s.cost)
            .collect();
        assert!(costs.iter().all(|&c| c == costs[0]), "a tie: {costs:?}");
    }
}
