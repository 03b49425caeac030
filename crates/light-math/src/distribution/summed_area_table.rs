#[cfg(feature = "alloc")]
use alloc::{vec, vec::Vec};

use super::axis::Axis;
use super::error::{TableError, check_len};
use super::quotient::quotient;
use super::span::Span;
use super::whole_sums::{UNITS, fill, power_of_two};
use super::window::Window;

/// Sums of a grid of weights over any rectangle, in constant time.
///
/// Weights are stored row by row from the lowest y, within a row by rising x. `S` lends the sums:
/// `Vec<u64>`, `&[u64]`, `[u64; M]`, one for each weight; sum `y * nx + x` counts all texels up to
/// column x and row y.
///
/// The sums are whole numbers, in a unit that is a power of two of about 2^-62 of the total. A
/// sum over texels is exact: never negative, zero only where all weights are, and the same in
/// whatever order it was built. A weight below the unit counts as one unit.
///
/// # Source
/// `[Crow1984]`; whole numbers are an addition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SummedAreaTable<S> {
    sums: S,
    nx: usize,
    ny: usize,
    log2_unit: i32,
}

#[cfg(feature = "alloc")]
impl SummedAreaTable<Vec<u64>> {
    /// The table of `ny` rows of `nx` weights each.
    ///
    /// # Errors
    /// [`TableError`] if there are no weights or not `nx * ny`, or if one is negative or not
    /// finite.
    pub fn new(weights: &[f32], nx: usize, ny: usize) -> Result<Self, TableError> {
        let mut sums = vec![0; weights.len()];
        let log2_unit = fill(weights, nx, ny, &mut sums)?;
        Ok(Self::of(sums, nx, ny, log2_unit))
    }
}

impl<const M: usize> SummedAreaTable<[u64; M]> {
    /// Like [`new`](SummedAreaTable::new), in an array; usable in a `const` or `static`.
    ///
    /// # Errors
    /// As for [`new`](SummedAreaTable::new).
    pub const fn in_array(weights: &[f32; M], nx: usize, ny: usize) -> Result<Self, TableError> {
        let mut sums = [0; M];
        match fill(weights, nx, ny, &mut sums) {
            Ok(log2_unit) => Ok(Self::of(sums, nx, ny, log2_unit)),
            Err(error) => Err(error),
        }
    }
}

impl<'a> SummedAreaTable<&'a [u64]> {
    /// Like [`new`](SummedAreaTable::new), in a buffer of as many sums as there are weights.
    ///
    /// # Errors
    /// As for [`new`](SummedAreaTable::new), and [`TableError::SizeMismatch`].
    pub fn build_into(
        weights: &[f32],
        nx: usize,
        ny: usize,
        sums: &'a mut [u64],
    ) -> Result<Self, TableError> {
        let log2_unit = fill(weights, nx, ny, sums)?;
        Ok(Self::of(sums, nx, ny, log2_unit))
    }
}

impl<S> SummedAreaTable<S> {
    const fn of(sums: S, nx: usize, ny: usize, log2_unit: i32) -> Self {
        Self {
            sums,
            nx,
            ny,
            log2_unit,
        }
    }
}

impl<S: AsRef<[u64]>> SummedAreaTable<S> {
    /// A table whose sums were built earlier, with the exponent of their [unit](Self::log2_unit).
    ///
    /// # Errors
    /// [`TableError`] if the numbers are not what [`sums`](Self::sums) and
    /// [`log2_unit`](Self::log2_unit) return for `nx` columns and `ny` rows.
    pub fn from_sums(sums: S, nx: usize, ny: usize, log2_unit: i32) -> Result<Self, TableError> {
        if let Some(error) = [Axis::unit(nx), Axis::unit(ny)]
            .into_iter()
            .find_map(Result::err)
        {
            return Err(error);
        }
        check_len(nx.saturating_mul(ny), sums.as_ref().len())?;
        let this = Self::of(sums, nx, ny, log2_unit);
        let at = |x: usize, y: usize| i128::from(this.below(x, y));
        let count = |x, y| at(x + 1, y + 1) - at(x, y + 1) - at(x + 1, y) + at(x, y);
        let is_well_formed = (0..ny).all(|y| (0..nx).all(|x| count(x, y) >= 0));
        if is_well_formed && UNITS.contains(&log2_unit) {
            Ok(this)
        } else {
            Err(TableError::Malformed)
        }
    }

    /// The integral over the part of `window` in the unit square, on which each weight covers its
    /// texel; over the whole square it is the mean of the weights.
    #[inline]
    #[must_use]
    pub fn integral(&self, window: &Window) -> f32 {
        let Some(window) = window.clip() else {
            return 0.0;
        };
        let spans = self.spans(&window);
        let steps = spans.iter().map(Span::log2_steps).sum::<i32>();
        let texels = (self.nx as u64 * self.ny as u64) as u128;
        quotient(self.total(&spans), texels, self.log2_unit - steps)
    }

    /// The sum of the weights in columns `x` and rows `y`, to the rounding of the result alone.
    ///
    /// Ranges are cut off at the edges of the grid. The result is a double, for it may be above any
    /// `f32`; this is the only query that needs one.
    #[inline]
    #[must_use]
    pub fn sum(&self, x: core::ops::Range<usize>, y: core::ops::Range<usize>) -> f64 {
        let x = x.start.min(self.nx)..x.end.min(self.nx);
        let y = y.start.min(self.ny)..y.end.min(self.ny);
        if x.is_empty() || y.is_empty() {
            return 0.0;
        }
        self.count(x, y) as f64 * power_of_two(self.log2_unit)
    }

    /// Columns and rows.
    #[inline]
    #[must_use]
    pub fn resolution(&self) -> [usize; 2] {
        [self.nx, self.ny]
    }

    /// All sums, to be stored and used again.
    #[must_use]
    pub fn sums(&self) -> &[u64] {
        self.sums.as_ref()
    }

    /// The exponent of the weight that one unit of the sums represents, a power of two.
    #[must_use]
    pub const fn log2_unit(&self) -> i32 {
        self.log2_unit
    }

    /// The sum over whole texels in units; the ranges lie in the grid.
    #[inline]
    pub(super) fn count(&self, x: core::ops::Range<usize>, y: core::ops::Range<usize>) -> u64 {
        let right = self.below(x.end, y.end) - self.below(x.end, y.start);
        let left = self.below(x.start, y.end) - self.below(x.start, y.start);
        right - left
    }

    /// The sum over a part of the unit square, in units of the table and both spans.
    #[inline]
    pub(super) fn total(&self, [columns, rows]: &[Span; 2]) -> u128 {
        columns.sum(|x| self.sum_below(x, rows))
    }

    /// The sum of what `rows` covers of the columns before `x`, in units of the table and `rows`.
    #[inline]
    pub(super) fn sum_below(&self, x: usize, rows: &Span) -> u128 {
        rows.sum(|y| self.below(x, y))
    }

    /// How `window`, a part of the unit square, covers columns and rows.
    #[inline]
    pub(super) fn spans(&self, window: &Window) -> [Span; 2] {
        [
            Span::new(window.min.x, window.max.x, self.nx),
            Span::new(window.min.y, window.max.y, self.ny),
        ]
    }

    /// The sum of the columns before `x` and the rows before `y`, in units.
    #[inline]
    pub(super) fn below(&self, x: usize, y: usize) -> u64 {
        if x == 0 || y == 0 {
            0
        } else {
            self.sums.as_ref()[(y - 1) * self.nx + x - 1]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    const WEIGHTS: [f32; 6] = [1.0, 0.0, 2.0, 4.0, 0.0, 5.0];

    #[test]
    fn sums_and_integrals() {
        let table = SummedAreaTable::new(&WEIGHTS, 3, 2).expect("valid weights");
        assert_eq!(table.integral(&Window::UNIT), 2.0, "mean");
        assert_eq!(table.sum(0..3, 0..2), 12.0, "all");
        assert_eq!(table.sum(1..3, 1..2), 5.0, "corner");
        assert_eq!(table.sum(2..9, 0..9), 7.0, "cut off at the edges");
        assert_eq!(table.sum(1..1, 0..2), 0.0, "nothing");
        let half_texel = Window::new(Vec2::new(0.5, 0.25), Vec2::new(1.0, 0.5));
        assert!(
            (table.integral(&half_texel) - 2.0 / 12.0).abs() < 1e-7,
            "in part"
        );
        let column = Window::new(Vec2::new(0.34, 0.0), Vec2::new(0.66, 1.0));
        assert_eq!(
            table.integral(&column),
            0.0,
            "an empty column is exactly empty"
        );
    }

    #[test]
    fn a_faint_corner_beside_a_sun_keeps_its_digits() {
        let mut weights = [1e-6; 64];
        weights[0] = 1e9;
        let table = SummedAreaTable::new(&weights, 8, 8).expect("valid weights");
        let corner = table.sum(7..8, 7..8);
        assert!(
            (corner / f64::from(1e-6f32) - 1.0).abs() < 1e-3,
            "corner {corner}"
        );
        let strip = table.sum(1..8, 1..8);
        assert!(
            (strip / (49.0 * corner) - 1.0).abs() < 1e-15,
            "strip {strip}"
        );
    }

    #[test]
    fn weights_at_the_ends_of_the_range() {
        let table = SummedAreaTable::new(&[f32::MAX, 1e-45, f32::MAX, 0.0], 2, 2).expect("finite");
        assert_eq!(table.sum(0..1, 0..2), 2.0 * f64::from(f32::MAX), "largest");
        assert!(table.sum(1..2, 0..1) > 0.0, "the smallest is not lost");
        assert_eq!(table.sum(1..2, 1..2), 0.0, "zero is zero");
        let tiny = SummedAreaTable::new(&[1e-45; 3], 3, 1).expect("finite");
        assert_eq!(tiny.sum(0..2, 0..1), 2.0 * f64::from(1e-45f32), "denormal");
        let dark = SummedAreaTable::new(&[0.0; 3], 3, 1).expect("zeros have sums");
        assert_eq!(
            (dark.sum(0..3, 0..1), dark.integral(&Window::UNIT)),
            (0.0, 0.0),
            "dark"
        );
    }

    #[test]
    fn storage_is_a_choice() {
        static IN_FLASH: SummedAreaTable<[u64; 6]> = match SummedAreaTable::in_array(&WEIGHTS, 3, 2)
        {
            Ok(table) => table,
            Err(_) => panic!("valid weights"),
        };
        let mut buffer = [0; 6];
        let borrowed = SummedAreaTable::build_into(&WEIGHTS, 3, 2, &mut buffer).expect("fits");
        assert_eq!(IN_FLASH.sums(), borrowed.sums(), "same builder");
        let again = SummedAreaTable::from_sums(borrowed.sums(), 3, 2, borrowed.log2_unit());
        assert_eq!(again, Ok(borrowed), "stored and used again");
    }

    #[test]
    fn refuses() {
        let new = |w: &[f32], nx, ny| SummedAreaTable::new(w, nx, ny).map(|_| ());
        let mismatch = |expected, found| Err(TableError::SizeMismatch { expected, found });
        assert_eq!(new(&[1.0; 5], 3, 2), mismatch(6, 5), "missing texel");
        assert_eq!(new(&[], 0, 0), Err(TableError::Empty), "empty");
        assert_eq!(
            new(&[1.0, -1.0], 2, 1),
            Err(TableError::Negative { index: 1 }),
            "negative"
        );
        assert_eq!(
            new(&[f32::NAN], 1, 1),
            Err(TableError::NotFinite { index: 0 }),
            "NaN"
        );
        let falling = SummedAreaTable::from_sums([2, 1], 2, 1, 0).map(|_| ());
        assert_eq!(falling, Err(TableError::Malformed), "sums that fall");
        let unit = SummedAreaTable::from_sums([1, 2], 2, 1, 115).map(|_| ());
        assert_eq!(unit, Err(TableError::Malformed), "more than floats sum to");
        let none = SummedAreaTable::from_sums([0; 0], 3, 0, 0).map(|_| ());
        assert_eq!(none, Err(TableError::Empty), "no rows");
    }
}
