use alloc::vec::Vec;
use core::f64::consts::PI;

use crate::glam::{DVec2, DVec3, Vec2, Vec3};
use crate::rgb_sum::single;
use light_math::float::{sin_cos, sqrt};

/// The texels of a lat-long image on the sphere, by
/// [`lat_long`](light_math::lat_long): where they are, and their exact integrals.
#[derive(Clone, Debug)]
pub(crate) struct LatLongGrid {
    size: [u32; 2],
    /// `(1 - cos t) / 2` of the edges of rows, from the pole to the middle or the row beyond it:
    /// the share of the sphere within the angle `t`, which keeps its digits at the pole.
    shares: Vec<f32>,
}

impl LatLongGrid {
    /// The grid of so many columns and rows.
    pub(crate) fn new(size: [u32; 2]) -> Self {
        let share = |y: u32| {
            let half_angle = 0.5 * PI * f64::from(y) / f64::from(size[1]);
            let sin = DVec2::from_angle(half_angle).y;
            single(sin * sin)
        };
        let shares = (0..=size[1].div_ceil(2)).map(share).collect();
        Self { size, shares }
    }

    /// The shares of the sphere within the upper edges of rows, from the pole to the first edge at
    /// or below the equator.
    pub(crate) fn shares(&self) -> &[f32] {
        &self.shares
    }

    /// The share of the sphere that row `y` covers: half the difference of the cosines at its
    /// edges.
    pub(crate) fn row_share(&self, y: u32) -> f64 {
        // From the nearer pole, where the sine keeps its digits.
        let row = y.min(self.size[1] - 1 - y);
        let half = 0.5 * PI / f64::from(self.size[1]);
        let middle = half * (2.0 * f64::from(row) + 1.0);
        DVec2::from_angle(middle).y * DVec2::from_angle(half).y
    }

    /// The integral of the direction over a texel of row `y`, as a share of the sphere: the factors
    /// of what [`columns`](Self::columns) says, for x and z, and the whole, for y.
    fn row_direction(&self, y: u32) -> DVec2 {
        let height = PI / f64::from(self.size[1]);
        let twice = DVec2::from_angle(height * (2.0 * f64::from(y) + 1.0));
        let sin = DVec2::from_angle(height).y;
        // Of sin^2 t and of sin t cos t between the edges.
        let aside = 0.5 * (height - twice.x * sin);
        let up = 0.5 * twice.y * sin;
        let column = 2.0 * PI / f64::from(self.size[0]);
        DVec2::new(aside, up * column) / (4.0 * PI)
    }

    /// The integrals of x and z over the width of each column at the equator, where directions lie
    /// in their plane.
    pub(crate) fn columns(&self) -> Vec<DVec2> {
        let half = PI / f64::from(self.size[0]);
        let chord = 2.0 * DVec2::from_angle(half).y;
        (0..self.size[0])
            .map(|x| {
                let middle = DVec2::from_angle(half * (2.0 * f64::from(x) + 1.0));
                chord * DVec2::new(middle.y, -middle.x)
            })
            .collect()
    }

    /// The integral of direction times weight, as a share of the sphere. Of each row, `sums` has
    /// the sum of weights times [`columns`](Self::columns), and of weights alone.
    pub(crate) fn direction_sum(&self, sums: impl IntoIterator<Item = (DVec2, f64)>) -> DVec3 {
        (0..self.size[1])
            .zip(sums)
            .map(|(y, (aside, weight))| {
                let factors = self.row_direction(y);
                DVec3::new(aside.x * factors.x, weight * factors.y, aside.y * factors.x)
            })
            .sum()
    }

    /// The unit vector at `place` in `[0, 1]^2` of a texel: uniform over its solid angle if `place`
    /// is uniform.
    #[inline]
    pub(crate) fn direction(&self, [x, y]: [u32; 2], place: Vec2) -> Vec3 {
        let rows = self.size[1];
        let is_upper = y < rows - y;
        let (row, part, side) = if is_upper {
            (y, place.y, 1.0)
        } else {
            (rows - 1 - y, 1.0 - place.y, -1.0)
        };
        let row = row as usize;
        let (near, far) = (self.shares[row], self.shares[row + 1]);
        let share = near + part * (far - near);
        let sin_t = 2.0 * sqrt(share * (1.0 - share));
        // From the middle of the map, where the angle is small.
        let turn = (x as f32 + place.x) / self.size[0] as f32 - 0.5;
        let (sin_p, cos_p) = sin_cos(core::f32::consts::TAU * turn);
        Vec3::new(-sin_t * sin_p, side * (1.0 - 2.0 * share), sin_t * cos_p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_math::lat_long;

    const SIZES: [[u32; 2]; 6] = [[1, 1], [1, 2], [7, 3], [64, 32], [5, 33], [4096, 2048]];

    #[test]
    fn rows_are_the_sphere() {
        for size in SIZES {
            let grid = LatLongGrid::new(size);
            let total: f64 = (0..size[1]).map(|y| grid.row_share(y)).sum();
            assert!((total - 1.0).abs() < 1e-13, "{size:?}: {total}");
            // What is sampled is rounded to single precision.
            for y in 0..size[1].div_ceil(2) {
                let edges = [y, y + 1].map(|y| f64::from(grid.shares[y as usize]));
                let error = edges[1] - edges[0] - grid.row_share(y);
                assert!(error.abs() < 6e-8, "{size:?}, row {y}: {error}");
            }
        }
    }

    #[test]
    fn places_are_in_their_texels() {
        for size in SIZES {
            let grid = LatLongGrid::new(size);
            let extent = Vec2::new(size[0] as f32, size[1] as f32);
            for y in [0, size[1] / 3, size[1] / 2, size[1] - 1] {
                for x in [0, size[0] / 2, size[0] - 1] {
                    for place in [Vec2::splat(0.5), Vec2::new(0.01, 0.99), Vec2::new(0.9, 0.1)] {
                        let w = grid.direction([x, y], place);
                        assert!((w.length() - 1.0).abs() < 3e-7, "{w}");
                        let at = lat_long::uv(w) * extent - Vec2::new(x as f32, y as f32);
                        let what = format_args!("{size:?}, {x} {y}: {at}");
                        assert!(at.min_element() > 0.0 && at.max_element() < 1.0, "{what}");
                        assert!((at.x - place.x).abs() < 2e-3, "even along a row, {what}");
                    }
                }
            }
        }
    }

    /// Of a weight of 1 everywhere, and of one column and one row alone.
    #[test]
    fn directions_are_integrated() {
        let size = [4, 2];
        let grid = LatLongGrid::new(size);
        let columns = grid.columns();
        let all: DVec2 = columns.iter().sum();
        let even = grid.direction_sum([(all, 4.0); 2]);
        assert!(even.length() < 1e-15, "nowhere: {even}");
        // An eighth of the sphere has the mean direction (1, 1, 1) / 2 to its corner.
        let corner = grid.direction_sum([(columns[1], 1.0), (DVec2::ZERO, 0.0)]);
        let expected = DVec3::new(0.5, 0.5, 0.5) / 8.0;
        assert!(corner.distance(expected) < 1e-15, "{corner}");
    }

    /// Of single texels, against the mean of even places.
    #[test]
    fn directions_are_those_of_each_texel() {
        let size = [8, 6];
        let grid = LatLongGrid::new(size);
        let columns = grid.columns();
        for y in 0..size[1] {
            for x in 0..size[0] {
                let of_row = |row| match row == y {
                    true => (columns[x as usize], 1.0),
                    false => (DVec2::ZERO, 0.0),
                };
                let found = grid.direction_sum((0..size[1]).map(of_row));
                let place = |i: u16| Vec2::new(f32::from(i % 32), f32::from(i / 32)) + 0.5;
                let places = (0..1024).map(|i| grid.direction([x, y], place(i) / 32.0).as_dvec3());
                let mean = places.sum::<DVec3>() / 1024.0;
                let expected = mean * grid.row_share(y) / f64::from(size[0]);
                let error = found.distance(expected) / expected.length();
                assert!(error < 1e-3, "{x}, {y}: {found}, {expected}");
            }
        }
    }
}
