#[cfg(feature = "alloc")]
use alloc::{vec, vec::Vec};

use super::axis::Axis;
use super::cumulative;
use super::densities::{fill_grid, grid_len};
use super::error::{TableError, check_len};
use glam::Vec2;

/// A density on a rectangle, constant in each texel of a grid: the usual way to sample an image.
///
/// Weights are stored row by row from the lowest y, within a row by rising x. `S` lends the
/// numbers: `Vec<f32>`, `&[f32]`, `[f32; M]`. They are the density of each texel over the unit
/// square, the running sum of each row, and the running sum of the rows,
/// [`table_len`](Self::table_len) in all.
///
/// # Source
/// `[PBRT4]` A.5.5: `u.y` picks the row, `u.x` the place in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PiecewiseConstant2D<S> {
    table: S,
    x: Axis,
    y: Axis,
    mean: f32,
}

/// A sample of a density on a rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample2D {
    /// The point, in the domain.
    pub p: Vec2,
    /// The density there, per area of the domain; above 0.
    pub pdf: f32,
    /// Column and row of the texel.
    pub texel: [usize; 2],
}

impl PiecewiseConstant2D<()> {
    /// The number of floats that the table of a grid of `nx` columns and `ny` rows takes.
    #[must_use]
    pub const fn table_len(nx: usize, ny: usize) -> usize {
        grid_len(nx, ny)
    }
}

#[cfg(feature = "alloc")]
impl PiecewiseConstant2D<Vec<f32>> {
    /// The density over the unit square proportional to `weights`, `ny` rows of `nx` each.
    ///
    /// # Errors
    /// [`TableError`] if there are no weights or not `nx * ny`, if all are zero, or if one is
    /// negative or not finite.
    pub fn new(weights: &[f32], nx: usize, ny: usize) -> Result<Self, TableError> {
        // Checked first, so that nonsense sizes do not allocate.
        check_len(nx.saturating_mul(ny), weights.len())?;
        let mut table = vec![0.0; PiecewiseConstant2D::table_len(nx, ny)];
        let ([x, y], mean) = fill_grid(weights, nx, ny, &mut table)?;
        Ok(Self { table, x, y, mean })
    }
}

impl<const M: usize> PiecewiseConstant2D<[f32; M]> {
    /// Like [`new`](PiecewiseConstant2D::new), in an array; usable in a `const` or `static`.
    ///
    /// # Errors
    /// As for [`new`](PiecewiseConstant2D::new), and [`TableError::SizeMismatch`] if `M` is not
    /// [`table_len`](PiecewiseConstant2D::table_len).
    pub const fn in_array(weights: &[f32], nx: usize, ny: usize) -> Result<Self, TableError> {
        let mut table = [0.0; M];
        match fill_grid(weights, nx, ny, &mut table) {
            Ok(([x, y], mean)) => Ok(Self { table, x, y, mean }),
            Err(error) => Err(error),
        }
    }
}

impl<'a> PiecewiseConstant2D<&'a [f32]> {
    /// Like [`new`](PiecewiseConstant2D::new), in a buffer of
    /// [`table_len`](PiecewiseConstant2D::table_len) floats.
    ///
    /// # Errors
    /// As for [`new`](PiecewiseConstant2D::new), and [`TableError::SizeMismatch`].
    pub fn build_into(
        weights: &[f32],
        nx: usize,
        ny: usize,
        table: &'a mut [f32],
    ) -> Result<Self, TableError> {
        let ([x, y], mean) = fill_grid(weights, nx, ny, table)?;
        Ok(Self { table, x, y, mean })
    }
}

impl<S: AsRef<[f32]>> PiecewiseConstant2D<S> {
    /// A table whose numbers were built earlier, with the mean of the weights.
    ///
    /// # Errors
    /// [`TableError`] if the numbers are not what [`table`](Self::table) returns for `nx` columns
    /// and `ny` rows.
    pub fn from_table(table: S, nx: usize, ny: usize, mean: f32) -> Result<Self, TableError> {
        let (x, y) = (Axis::unit(nx)?, Axis::unit(ny)?);
        let found = table.as_ref().len();
        check_len(PiecewiseConstant2D::table_len(nx, ny), found)?;
        let this = Self { table, x, y, mean };
        let is_well_formed = (0..ny).all(|row| {
            let marginal = this.marginal();
            let is_reached = marginal[row] < marginal[row + 1];
            let has_density = this.densities(row).iter().any(|&d| d > 0.0);
            cumulative::is_well_formed(this.densities(row), this.sums(row))
                && marginal[row] <= marginal[row + 1]
                && (has_density || !is_reached)
        });
        let ends = [this.marginal()[0], this.marginal()[ny]];
        if is_well_formed && ends == [0.0, 1.0] && mean > 0.0 && mean.is_finite() {
            Ok(this)
        } else {
            Err(TableError::Malformed)
        }
    }

    /// The same density stretched over the rectangle from `min` to `max`.
    ///
    /// # Errors
    /// [`TableError::Domain`] unless `min < max` on both axes and all is finite,
    /// [`TableError::Overflow`] if the area or the integral is not.
    pub fn over(self, min: Vec2, max: Vec2) -> Result<Self, TableError> {
        let x = self.x.over(min.x, max.x)?;
        let y = self.y.over(min.y, max.y)?;
        let this = Self { x, y, ..self };
        if this.integral().is_finite() && this.area().is_finite() && this.area() > 0.0 {
            Ok(this)
        } else {
            Err(TableError::Overflow)
        }
    }

    /// The point for `u` in `[0, 1)^2`.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: Vec2) -> Sample2D {
        let (row, y) = cumulative::sample(self.marginal(), u.y);
        let (column, x) = cumulative::sample(self.sums(row), u.x);
        Sample2D {
            p: Vec2::new(self.x.place(column, x), self.y.place(row, y)),
            pdf: self.densities(row)[column] / self.area(),
            texel: [column, row],
        }
    }

    /// The density at `p`, per area of the domain; 0 outside it.
    #[inline]
    #[must_use]
    pub fn pdf(&self, p: Vec2) -> f32 {
        self.texel_at(p).map_or(0.0, |[column, row]| {
            self.densities(row)[column] / self.area()
        })
    }

    /// Column and row of the texel that holds `p`; `None` outside the domain.
    #[inline]
    #[must_use]
    pub fn texel_at(&self, p: Vec2) -> Option<[usize; 2]> {
        let ((column, _), (row, _)) = self.x.locate(p.x).zip(self.y.locate(p.y))?;
        Some([column, row])
    }

    /// The `u` in `[0, 1]^2` that [`sample`](Self::sample) takes to `p`; `None` outside the domain.
    #[must_use]
    pub fn invert(&self, p: Vec2) -> Option<Vec2> {
        let (column, x) = self.x.locate(p.x)?;
        let (row, y) = self.y.locate(p.y)?;
        Some(Vec2::new(
            cumulative::invert(self.sums(row), column, x),
            cumulative::invert(self.marginal(), row, y),
        ))
    }

    /// The integral of the weights over the domain.
    #[must_use]
    pub fn integral(&self) -> f32 {
        self.mean * self.area()
    }

    /// The mean of the weights.
    #[must_use]
    pub fn mean(&self) -> f32 {
        self.mean
    }

    /// Columns and rows.
    #[must_use]
    pub fn resolution(&self) -> [usize; 2] {
        [self.x.bins(), self.y.bins()]
    }

    /// All numbers, to be stored and used again.
    #[must_use]
    pub fn table(&self) -> &[f32] {
        self.table.as_ref()
    }

    #[inline]
    fn area(&self) -> f32 {
        self.x.width() * self.y.width()
    }

    #[inline]
    fn densities(&self, row: usize) -> &[f32] {
        let nx = self.x.bins();
        &self.table.as_ref()[row * nx..][..nx]
    }

    #[inline]
    fn sums(&self, row: usize) -> &[f32] {
        let [nx, ny] = self.resolution();
        &self.table.as_ref()[nx * ny + row * (nx + 1)..][..=nx]
    }

    #[inline]
    fn marginal(&self) -> &[f32] {
        let [nx, ny] = self.resolution();
        &self.table.as_ref()[ny * (2 * nx + 1)..]
    }
}

#[cfg(test)]
mod tests;
