use light_math::Aabb;
use light_math::glam::Vec3;

use crate::build::cluster::{Cluster, Sums};

/// Bins on each axis.
pub(crate) const BINS: usize = 8;

/// The bins that lights fall into.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    low: Vec3,
    scale: Vec3,
    /// Along which axes a split may pay: those at least half as long as the longest.
    is_long: [bool; 3],
}

impl Grid {
    /// Bins that fill `bounds`.
    pub(crate) fn new(bounds: &Aabb) -> Self {
        const FLAT: f32 = 1e-30;
        let extent = bounds.diagonal();
        let scale = Vec3::splat(BINS as f32 * (1.0 - 1e-6)) / extent.max(Vec3::splat(FLAT));
        Self {
            low: bounds.min,
            scale: Vec3::select(extent.cmpgt(Vec3::splat(FLAT)), scale, Vec3::ZERO),
            is_long: extent.cmpge(0.5 * Vec3::splat(extent.max_element())).into(),
        }
    }

    /// The axes along which lights are divided, at least one.
    #[inline]
    pub(crate) fn axes(&self) -> impl Iterator<Item = usize> {
        let is_long = self.is_long;
        (0..3).filter(move |&axis| is_long[axis])
    }

    /// The bins by position.
    #[inline]
    pub(crate) fn position(&self, cluster: &Cluster) -> [usize; 3] {
        ((cluster.center - self.low) * self.scale)
            .to_array()
            .map(bin)
    }

    /// The bin by position along one axis.
    #[inline]
    pub(crate) fn along(&self, cluster: &Cluster, axis: usize) -> usize {
        bin((cluster.center[axis] - self.low[axis]) * self.scale[axis])
    }

    /// The sums of `clusters` in bins by position along each of the [axes](Self::axes).
    pub(crate) fn sums_by_position(&self, clusters: &[Cluster]) -> [Bins; 3] {
        let mut bins = [Bins::EMPTY; 3];
        for cluster in clusters {
            let sums = Sums::of(cluster, cluster.center - self.low);
            let position = self.position(cluster);
            for axis in self.axes() {
                let bin = &mut bins[axis].0[position[axis]];
                *bin = bin.plus(&sums);
            }
        }
        bins
    }
}

#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "float to integer casts saturate, and the bin is clamped"
)]
fn bin(x: f32) -> usize {
    (x as u32).min(BINS as u32 - 1) as usize
}

/// Whether few clusters are in places with much space between them: at most one in four cells of a
/// cube about their box `bounds`, of which eight fill each side. Two halves as large as a node would
/// tear such places apart.
pub(crate) fn is_in_few_places(clusters: &[Cluster], bounds: &Aabb) -> bool {
    let side = Vec3::splat(bounds.diagonal().max_element());
    let grid = Grid::new(&Aabb {
        min: bounds.min,
        max: bounds.min + side,
    });
    let mut cells = [0u64; BINS];
    for cluster in clusters {
        let [x, y, z] = grid.position(cluster);
        cells[z] |= 1 << (BINS * y + x);
    }
    let places: u32 = cells.iter().map(|layer| layer.count_ones()).sum();
    (2..=clusters.len() / 4).contains(&(places as usize))
}

/// Lights up to `bin` go left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    pub(crate) bin: usize,
    pub(crate) costs: [f32; 2],
}

impl Plane {
    pub(crate) fn cost(&self) -> f32 {
        self.costs[0] + self.costs[1]
    }
}

/// The sums of the lights in each bin of a row.
pub(crate) struct Bins([Sums; BINS]);

impl Bins {
    const EMPTY: Self = Self([Sums([0.0; 9]); BINS]);

    /// The cheapest plane with lights on both sides.
    pub(crate) fn best_plane(&self) -> Option<Plane> {
        let mut left = self.0;
        for bin in 1..BINS {
            left[bin] = left[bin].plus(&left[bin - 1]);
        }
        let mut right = self.0;
        for bin in (0..BINS - 1).rev() {
            right[bin] = right[bin].plus(&right[bin + 1]);
        }
        let (left_costs, right_costs) = (costs(&left), costs(&right));
        let mut best: Option<Plane> = None;
        for bin in 0..BINS - 1 {
            let plane = Plane {
                bin,
                costs: [left_costs[bin], right_costs[bin + 1]],
            };
            let divides = left[bin].power() > 0.0 && right[bin + 1].power() > 0.0;
            if divides && best.is_none_or(|best| plane.cost() < best.cost()) {
                best = Some(plane);
            }
        }
        best
    }
}

/// All at once: most of the time of a split of few lights goes here.
fn costs(sums: &[Sums; BINS]) -> [f32; BINS] {
    let mut columns = [[0.0; BINS]; 9];
    for (bin, sums) in sums.iter().enumerate() {
        for (column, sum) in columns.iter_mut().zip(sums.0) {
            column[bin] = sum;
        }
    }
    let mut costs = [0.0; BINS];
    for (bin, cost) in costs.iter_mut().enumerate() {
        *cost = Sums(core::array::from_fn(|i| columns[i][bin])).cost();
    }
    costs
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;

    #[test]
    fn two_rooms_are_in_few_places_and_a_hall_is_not() {
        let is_few = |place: &dyn Fn(u16) -> Vec3| {
            let clusters: Vec<_> = (0..20)
                .map(|i| Cluster {
                    center: place(i),
                    ..Cluster::NOTHING
                })
                .collect();
            let centers = clusters.iter().map(|cluster| cluster.center);
            let bounds = centers.fold(Aabb::EMPTY, |bounds, p| bounds.extend(p));
            is_in_few_places(&clusters, &bounds)
        };
        let in_hall = |i: u16| Vec3::new(f32::from(i % 5), f32::from(i % 3), 0.0);
        assert!(!is_few(&in_hall), "a hall");
        assert!(is_few(&|i| in_hall(i) + f32::from(i % 2) * 1e3 * Vec3::Y));
        assert!(!is_few(&|_| Vec3::ONE), "one place");
        assert!(!is_few(&|i| f32::from(i) * Vec3::Z), "a row");
    }
}
