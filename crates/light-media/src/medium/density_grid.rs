use super::grid::{Grid, GridError};
use super::majorant_grid::MajorantGrid;
use light_math::glam::Vec3;

/// A density over the unit cube: a [`Grid`] of one channel with upper bounds for coarse cells.
///
/// Costs 4 bytes a sample and 16 KiB for the maxima of coarse cells.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DensityGrid<S> {
    grid: Grid<S>,
    // Derived from the samples.
    #[cfg_attr(feature = "serde", serde(skip))]
    majorants: MajorantGrid,
}

impl<S: AsRef<[f32]>> DensityGrid<S> {
    /// The grid of `size[0] * size[1] * size[2]` values, x fastest.
    ///
    /// # Errors
    /// A size is zero, the number of values does not fit the sizes, or a value is negative or not
    /// finite.
    pub fn new(size: [u32; 3], values: S) -> Result<Self, GridError> {
        let grid = Grid::new(size, values)?;
        let majorants = MajorantGrid::new(size, grid.maxima());
        Ok(Self { grid, majorants })
    }

    /// The value at `p` of the unit cube, trilinearly interpolated, zero outside.
    #[inline]
    #[must_use]
    pub fn lookup(&self, p: Vec3) -> f32 {
        let [density] = self.grid.lookup(p);
        density
    }

    /// The largest value of all.
    pub(super) fn max_value(&self) -> f32 {
        self.grid.max_value()
    }

    /// The maxima of coarse cells.
    #[must_use]
    pub(super) const fn majorants(&self) -> &MajorantGrid {
        &self.majorants
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// Many of the values are 0.
    fn sparse(size: [u32; 3]) -> DensityGrid<Vec<f32>> {
        let n: u32 = size.iter().product();
        let value = |i| ((i * 7919) % 101) as f32 - 60.0;
        DensityGrid::new(size, (0..n).map(|i| value(i).max(0.0)).collect()).expect("valid")
    }

    #[test]
    fn coarse_maxima_bound_every_lookup_in_a_cell_and_just_beside_it() {
        let margin = 0.99 / f32::from(MajorantGrid::MARGINS_PER_CELL);
        let sizes = [[1, 1, 1], [2, 5, 3], [40, 16, 33], [8, 1, 500], [500, 8, 1]];
        for size in sizes {
            let grid = sparse(size);
            for i in 0..20_000u32 {
                // A low-discrepancy sequence in the cube.
                let p = (Vec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5) * i as f32).fract();
                for side in [-margin, 0.0, margin] {
                    let places = p * MajorantGrid::CELLS as f32 + side;
                    let places = places.clamp(Vec3::ZERO, Vec3::splat(15.9));
                    let bound = grid.majorants().get(places.to_array().map(|x| x as i32));
                    let value = grid.lookup(p);
                    assert!(value <= bound * 1.000_01, "size {size:?}, p {p}, {side}");
                }
            }
        }
    }
}
