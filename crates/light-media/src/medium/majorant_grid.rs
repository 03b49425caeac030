/// The largest interpolated value in each of 16^3 equal cells of the unit cube, and in a thin
/// margin around it.
#[derive(Clone, Debug)]
pub(super) struct MajorantGrid {
    maxima: [f32; Self::COUNT],
}

impl MajorantGrid {
    /// Cells on each axis.
    pub(super) const CELLS: usize = 16;

    /// The maximum of a cell also bounds values beyond it, up to one over this of its size.
    pub(super) const MARGINS_PER_CELL: u8 = 64;

    const COUNT: usize = Self::CELLS * Self::CELLS * Self::CELLS;

    /// The maxima of a grid of that size, of which `values` are the samples.
    pub(super) fn new(size: [u32; 3], values: impl Iterator<Item = f32>) -> Self {
        let mut maxima = [0.0f32; Self::COUNT];
        let [nx, ny, nz] = size.map(|n| n as usize);
        for (index, value) in values.enumerate() {
            let xs = cells_reached(index % nx, nx);
            let ys = cells_reached(index / nx % ny, ny);
            let zs = cells_reached(index / (nx * ny), nz);
            for z in zs {
                for y in ys.clone() {
                    for x in xs.clone() {
                        let cell = &mut maxima[(z * Self::CELLS + y) * Self::CELLS + x];
                        *cell = cell.max(value);
                    }
                }
            }
        }
        Self { maxima }
    }

    /// The maximum in cell `(x, y, z)`; 0 outside.
    pub(super) fn get(&self, cell: [i32; 3]) -> f32 {
        let [x, y, z] = cell.map(|i| usize::try_from(i).ok().filter(|i| *i < Self::CELLS));
        match (x, y, z) {
            (Some(x), Some(y), Some(z)) => self.maxima[(z * Self::CELLS + y) * Self::CELLS + x],
            _ => 0.0,
        }
    }

    /// The largest maximum of the cells up to `reach` away from one, on each axis.
    pub(super) fn max_near(&self, cell: [i32; 3], reach: [i32; 3]) -> f32 {
        if reach == [0; 3] {
            return self.get(cell);
        }
        let inside = |i: i32| usize::try_from(i).unwrap_or(0).min(Self::CELLS);
        let [xs, ys, zs] =
            [0, 1, 2].map(|i: usize| inside(cell[i] - reach[i])..inside(cell[i] + reach[i] + 1));
        let mut most = 0.0f32;
        for z in zs {
            for y in ys.clone() {
                let row = (z * Self::CELLS + y) * Self::CELLS;
                let row = &self.maxima[row + xs.start..row + xs.end];
                most = row.iter().copied().fold(most, f32::max);
            }
        }
        most
    }
}

/// The cells that sample `i` of `n` influences: interpolation extends it by one sample spacing to
/// both sides of its position `i + 1/2`, and rounding by the margin.
fn cells_reached(i: usize, n: usize) -> core::ops::RangeInclusive<usize> {
    const CELLS: u64 = MajorantGrid::CELLS as u64;
    const MARGINS: u64 = MajorantGrid::MARGINS_PER_CELL as u64;
    // In halves of a sample from 2 i - 1 to 2 i + 3, of 2 n in all; with the margin in parts of
    // which a cell has as many as this.
    let (i, halves) = (i as u64, 2 * n as u64);
    let parts = MARGINS * halves;
    let start = (MARGINS * CELLS * (2 * i).saturating_sub(1)).saturating_sub(halves);
    let end = MARGINS * CELLS * (2 * i + 3) + halves;
    let [first, last] = [start, end].map(|place| (place / parts).min(CELLS - 1) as usize);
    first..=last
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_outside_of_the_grid_are_empty() {
        let grid = MajorantGrid::new([1, 1, 1], [2.0].into_iter());
        let last = i32::try_from(MajorantGrid::CELLS).expect("few") - 1;
        assert_eq!(grid.get([0, last, 0]), 2.0, "a corner");
        for outside in [[-1, 0, 0], [0, last + 1, 0], [0, 0, i32::MAX]] {
            assert_eq!(grid.get(outside), 0.0, "{outside:?}");
        }
    }

    #[test]
    fn samples_reach_just_beyond_the_wall_of_a_cell() {
        assert_eq!(cells_reached(33, 500), 1..=1, "from 1.04 to 1.104");
        assert_eq!(cells_reached(32, 500), 0..=1, "from 1.008 to 1.072");
        assert_eq!(cells_reached(92, 500), 2..=3, "from 2.928 to 2.992");
        assert_eq!(cells_reached(0, 500), 0..=0, "the first");
        assert_eq!(cells_reached(499, 500), 15..=15, "the last");
    }

    #[test]
    fn near_cells_are_those_within_reach() {
        let cell = |i: usize| {
            let n = MajorantGrid::CELLS;
            [i % n, i / n % n, i / (n * n)].map(|i| i32::try_from(i).expect("few"))
        };
        let mut grid = MajorantGrid::new([1, 1, 1], [0.0].into_iter());
        for (i, max) in grid.maxima.iter_mut().enumerate() {
            *max = ((i * 7919) % 101) as f32;
        }
        for (at, reach) in [
            ([3, 7, 12], [0, 0, 0]),
            ([3, 7, 12], [1, 2, 0]),
            ([0, 15, 8], [1, 1, 1]),
            ([5, 5, 5], [16, 0, 16]),
            ([5, 5, 5], [16, 16, 16]),
        ] {
            let is_near = |cell: [i32; 3]| (0..3).all(|i| (cell[i] - at[i]).abs() <= reach[i]);
            let near = (0..MajorantGrid::COUNT).filter(|i| is_near(cell(*i)));
            let expected = near.map(|i| grid.maxima[i]).fold(0.0, f32::max);
            assert_eq!(grid.max_near(at, reach), expected, "{at:?}, {reach:?}");
        }
    }
}
