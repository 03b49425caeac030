use light_bounds::LightBounds;
use light_bounds::light_math::Aabb;
use light_bounds::light_math::glam::Vec3;

use super::cost::side_cost;

/// Buckets per axis.
const BUCKETS: usize = 12;

/// Where to divide the lights of a node: after a bucket of an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Split {
    axis: usize,
    last_of_first: usize,
    centroids: Aabb,
}

impl Split {
    /// Whether a light with this centroid goes to the first child.
    pub(super) fn is_first(&self, centroid: Vec3) -> bool {
        bucket(centroid, &self.centroids, self.axis) <= self.last_of_first
    }
}

/// The cheapest split of the lights between two buckets of any axis, each side with at least one
/// light; `None` if all centroids are the same.
///
/// The first and the last bucket of an axis are never empty. The first two always stay together, as
/// in the source. A split that costs nothing is taken, unlike there, except that two such lights
/// stay in their order.
///
/// # Source
/// `[PBRT4]`, section 12.6.3, and its implementation.
pub(super) fn cheapest_split(
    lights: impl ExactSizeIterator<Item = (LightBounds, Vec3)> + Clone,
    bounds: &Aabb,
    centroids: &Aabb,
) -> Option<Split> {
    let mut best = None;
    let mut least = f64::INFINITY;
    for axis in 0..3 {
        if !(half_extent(centroids, axis) > 0.0) {
            continue;
        }
        let mut buckets = [LightBounds::EMPTY; BUCKETS];
        for (light, centroid) in lights.clone() {
            let bucket = &mut buckets[bucket(centroid, centroids, axis)];
            *bucket = bucket.union(&light);
        }
        let filled = buckets.map(|bucket| bucket.phi > 0.0);
        let mut first = buckets[0];
        for end in 1..BUCKETS - 1 {
            // An empty bucket at the end of a side changes nothing.
            if end > 1 && !filled[end] {
                continue;
            }
            first = first.union(&buckets[end]);
            let second = buckets[end + 1..]
                .iter()
                .fold(LightBounds::EMPTY, |all, bucket| all.union(bucket));
            let cost = side_cost(&first, bounds, axis) + side_cost(&second, bounds, axis);
            if cost < least && (cost > 0.0 || lights.len() > 2) {
                least = cost;
                best = Some(Split {
                    axis,
                    last_of_first: end,
                    centroids: *centroids,
                });
            }
        }
    }
    best
}

/// The bucket of a centroid within the box of all centroids, which has an extent along `axis`.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "in [0, 12]; the cast truncates on purpose"
)]
fn bucket(centroid: Vec3, centroids: &Aabb, axis: usize) -> usize {
    let offset = (0.5 * centroid[axis] - 0.5 * centroids.min[axis]) / half_extent(centroids, axis);
    ((BUCKETS as f32 * offset) as usize).min(BUCKETS - 1)
}

/// Half, so that no difference overflows.
fn half_extent(centroids: &Aabb, axis: usize) -> f32 {
    0.5 * centroids.max[axis] - 0.5 * centroids.min[axis]
}
