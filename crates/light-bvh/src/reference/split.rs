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

/// The cheapest split of the lights between two buckets of any axis, each side with at least one light; `None` if all
/// centroids are the same.
///
/// # Source
/// `[PBRT4]`, section 12.6.3, with every bucket's end tried.
pub(super) fn cheapest_split(
    lights: impl Iterator<Item = (LightBounds, Vec3)> + Clone,
    bounds: &Aabb,
    centroids: &Aabb,
) -> Option<Split> {
    let mut best = None;
    let mut least = f64::INFINITY;
    for axis in 0..3 {
        if !(centroids.min[axis] < centroids.max[axis]) {
            continue;
        }
        let mut buckets = [LightBounds::EMPTY; BUCKETS];
        for (light, centroid) in lights.clone() {
            let bucket = &mut buckets[bucket(centroid, centroids, axis)];
            *bucket = bucket.union(&light);
        }
        let filled = buckets.map(|bucket| bucket.phi > 0.0);
        let mut first = LightBounds::EMPTY;
        for end in 0..BUCKETS - 1 {
            if !filled[end] || !filled[end + 1..].contains(&true) {
                continue;
            }
            first = first.union(&buckets[end]);
            let second = buckets[end + 1..]
                .iter()
                .fold(LightBounds::EMPTY, |all, bucket| all.union(bucket));
            let cost = side_cost(&first, bounds, axis) + side_cost(&second, bounds, axis);
            if cost < least {
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
    // Halves, so that no difference overflows.
    let [c, min, max] = [centroid, centroids.min, centroids.max].map(|v| 0.5 * v[axis]);
    let offset = (c - min) / (max - min);
    ((BUCKETS as f32 * offset) as usize).min(BUCKETS - 1)
}
