/// The largest interpolated value in each of 16^3 equal cells of the unit cube.
#[derive(Clone, Debug)]
pub(super) struct MajorantGrid {
    maxima: [f32; Self::COUNT],
}

impl MajorantGrid {
    /// Cells on each axis.
    pub(super) const CELLS: usize = 16;

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
}

/// The cells that sample `i` of `n` influences: interpolation extends it by one sample spacing to
/// both sides of its position `i + 1/2`.
fn cells_reached(i: usize, n: usize) -> core::ops::RangeInclusive<usize> {
    // In halves of a sample: from 2 i - 1 to 2 i + 3, of 2 n in all.
    let cell =
        |halves: usize| (halves * MajorantGrid::CELLS / (2 * n)).min(MajorantGrid::CELLS - 1);
    cell((2 * i).saturating_sub(1))..=cell(2 * i + 3)
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
}
