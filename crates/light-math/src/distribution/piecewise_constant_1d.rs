#[cfg(feature = "alloc")]
use alloc::{vec, vec::Vec};

use super::axis::Axis;
use super::cumulative;
use super::densities::{fill_line, line_len};
use super::error::{TableError, check_len};

/// A density on an interval, constant in each of equal bins.
///
/// `S` lends the numbers: `Vec<f32>`, `&[f32]`, `[f32; M]`. They are the density of each bin over
/// the unit interval, then the running sum, [`table_len`](Self::table_len) in all.
///
/// ```
/// # use light_math::distribution::PiecewiseConstant1D;
/// let steps = PiecewiseConstant1D::new(&[1.0, 0.0, 3.0])?;
/// let sample = steps.sample(0.625);
/// assert_eq!((sample.index, sample.pdf), (2, 2.25));
/// # Ok::<(), light_math::distribution::TableError>(())
/// ```
///
/// # Source
/// `[PBRT4]` A.4.7.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PiecewiseConstant1D<S> {
    table: S,
    axis: Axis,
    mean: f32,
}

/// A sample of a [`PiecewiseConstant1D`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample1D {
    /// The point, in the domain.
    pub x: f32,
    /// The density there, per unit of the domain; above 0.
    pub pdf: f32,
    /// The bin that holds `x`, counted from 0 at the low end.
    pub index: usize,
}

impl PiecewiseConstant1D<()> {
    /// The number of floats that the table of `bins` bins takes.
    #[must_use]
    pub const fn table_len(bins: usize) -> usize {
        line_len(bins)
    }
}

#[cfg(feature = "alloc")]
impl PiecewiseConstant1D<Vec<f32>> {
    /// The density over `[0, 1]` proportional to `weights`: `weights[i]` is that of the `i`th bin.
    ///
    /// # Errors
    /// [`TableError`] if there are no weights, all are zero, or one is negative or not finite.
    pub fn new(weights: &[f32]) -> Result<Self, TableError> {
        let mut table = vec![0.0; PiecewiseConstant1D::table_len(weights.len())];
        let (axis, mean) = fill_line(weights, &mut table)?;
        Ok(Self { table, axis, mean })
    }
}

impl<const M: usize> PiecewiseConstant1D<[f32; M]> {
    /// Like [`new`](PiecewiseConstant1D::new), in an array; usable in a `const` or `static`.
    ///
    /// # Errors
    /// As for [`new`](PiecewiseConstant1D::new), and [`TableError::SizeMismatch`] if `M` is not
    /// [`table_len`](PiecewiseConstant1D::table_len) of the number of weights.
    pub const fn in_array(weights: &[f32]) -> Result<Self, TableError> {
        let mut table = [0.0; M];
        match fill_line(weights, &mut table) {
            Ok((axis, mean)) => Ok(Self { table, axis, mean }),
            Err(error) => Err(error),
        }
    }
}

impl<'a> PiecewiseConstant1D<&'a [f32]> {
    /// Like [`new`](PiecewiseConstant1D::new), in a buffer of
    /// [`table_len`](PiecewiseConstant1D::table_len) floats.
    ///
    /// # Errors
    /// As for [`new`](PiecewiseConstant1D::new), and [`TableError::SizeMismatch`].
    pub fn build_into(weights: &[f32], table: &'a mut [f32]) -> Result<Self, TableError> {
        let (axis, mean) = fill_line(weights, table)?;
        Ok(Self { table, axis, mean })
    }
}

impl<S: AsRef<[f32]>> PiecewiseConstant1D<S> {
    /// A table whose numbers were built earlier, with the mean of the weights.
    ///
    /// # Errors
    /// [`TableError`] if the numbers are not what [`table`](Self::table) returns.
    pub fn from_table(table: S, mean: f32) -> Result<Self, TableError> {
        let numbers = table.as_ref();
        let axis = Axis::unit(numbers.len().saturating_sub(1) / 2)?;
        check_len(PiecewiseConstant1D::table_len(axis.bins()), numbers.len())?;
        let (densities, sums) = numbers.split_at(axis.bins());
        let has_density = densities.iter().any(|&d| d > 0.0) && mean > 0.0 && mean.is_finite();
        if !has_density || !cumulative::is_well_formed(densities, sums) {
            return Err(TableError::Malformed);
        }
        Ok(Self { table, axis, mean })
    }

    /// The same density stretched over `[min, max]`.
    ///
    /// # Errors
    /// [`TableError::Domain`] unless `min < max` and both are finite, [`TableError::Overflow`] if
    /// the integral is not.
    pub fn over(self, min: f32, max: f32) -> Result<Self, TableError> {
        let axis = self.axis.over(min, max)?;
        if !(self.mean * axis.width()).is_finite() {
            return Err(TableError::Overflow);
        }
        Ok(Self { axis, ..self })
    }

    /// The point for `u` in `[0, 1)`.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: f32) -> Sample1D {
        let (densities, sums) = self.parts();
        let (index, place) = cumulative::sample(sums, u);
        Sample1D {
            x: self.axis.place(index, place),
            pdf: densities[index] / self.axis.width(),
            index,
        }
    }

    /// The density at `x`, per unit of the domain; 0 outside it.
    #[inline]
    #[must_use]
    pub fn pdf(&self, x: f32) -> f32 {
        match self.axis.locate(x) {
            Some((index, _)) => self.parts().0[index] / self.axis.width(),
            None => 0.0,
        }
    }

    /// The `u` in `[0, 1]` that [`sample`](Self::sample) takes to `x`; `None` outside the domain.
    #[must_use]
    pub fn invert(&self, x: f32) -> Option<f32> {
        let (index, place) = self.axis.locate(x)?;
        Some(cumulative::invert(self.parts().1, index, place))
    }

    /// The integral of the weights over the domain.
    #[must_use]
    pub fn integral(&self) -> f32 {
        self.mean * self.axis.width()
    }

    /// The mean of the weights.
    #[must_use]
    pub fn mean(&self) -> f32 {
        self.mean
    }

    /// The running sum of the densities, from 0 to 1: one number more than bins.
    #[must_use]
    pub fn cdf(&self) -> &[f32] {
        self.parts().1
    }

    /// All numbers, to be stored and used again.
    #[must_use]
    pub fn table(&self) -> &[f32] {
        self.table.as_ref()
    }

    #[inline]
    fn parts(&self) -> (&[f32], &[f32]) {
        self.table.as_ref().split_at(self.axis.bins())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::float::ONE_MINUS_EPSILON;

    #[test]
    fn samples_densities_and_inverses() {
        let d = PiecewiseConstant1D::new(&[1.0, 0.0, 3.0]).and_then(|d| d.over(-1.0, 2.0));
        let d = d.expect("valid weights");
        assert_eq!(d.integral(), 4.0, "integral");
        assert_eq!(
            (d.pdf(-0.5), d.pdf(0.5), d.pdf(1.5)),
            (0.25, 0.0, 0.75),
            "densities"
        );
        assert_eq!(
            (d.pdf(-1.1), d.pdf(2.1), d.pdf(f32::NAN)),
            (0.0, 0.0, 0.0),
            "outside"
        );
        for u in [0.0, 0.1, 0.249, 0.25, 0.7, ONE_MINUS_EPSILON] {
            let s = d.sample(u);
            assert_eq!(s.pdf, d.pdf(s.x), "same density at {u}");
            assert!(s.pdf > 0.0 && s.index != 1, "positive density at {u}");
            let back = d.invert(s.x).expect("inside");
            assert!((back - u).abs() < 1e-6, "round trip of {u}: {back}");
        }
        assert_eq!(d.invert(2.5), None, "outside");
    }

    #[test]
    fn a_sample_never_slips_into_an_empty_neighbour() {
        let weights: Vec<f32> = (0..1001u16).map(|i| f32::from(i % 2)).collect();
        let d = PiecewiseConstant1D::new(&weights).expect("valid weights");
        for i in 0..20_000u16 {
            let u = f32::from(i) / 20_000.0;
            assert!(d.pdf(d.sample(u).x) > 0.0, "density at {u}");
        }
        for &u in &d.cdf()[..1000] {
            assert!(
                d.pdf(d.sample(u).x) > 0.0,
                "density at the start {u} of a bin"
            );
            let u = crate::float::next_down(u);
            assert!(
                d.pdf(d.sample(u).x) > 0.0,
                "density at the end {u} of a bin"
            );
        }
    }

    #[test]
    fn storage_is_a_choice() {
        const WEIGHTS: [f32; 2] = [1.0, 3.0];
        static IN_FLASH: PiecewiseConstant1D<[f32; 5]> =
            match PiecewiseConstant1D::in_array(&WEIGHTS) {
                Ok(table) => table,
                Err(_) => panic!("valid weights"),
            };
        let mut buffer = [0.0; 5];
        let borrowed = PiecewiseConstant1D::build_into(&WEIGHTS, &mut buffer).expect("fits");
        assert_eq!(IN_FLASH.table(), borrowed.table(), "same builder");
        let again = PiecewiseConstant1D::from_table(borrowed.table(), borrowed.mean());
        assert_eq!(again, Ok(borrowed), "stored and used again");
    }

    #[test]
    fn refuses() {
        let new = |w: &[f32]| PiecewiseConstant1D::new(w).map(|_| ());
        assert_eq!(new(&[]), Err(TableError::Empty), "empty");
        assert_eq!(new(&[0.0, 0.0]), Err(TableError::AllZero), "zero");
        assert_eq!(
            new(&[-1.0]),
            Err(TableError::Negative { index: 0 }),
            "negative"
        );
        let short = PiecewiseConstant1D::<[f32; 4]>::in_array(&[1.0, 1.0]).map(|_| ());
        let mismatch = TableError::SizeMismatch {
            expected: 5,
            found: 4,
        };
        assert_eq!(short, Err(mismatch), "short array");
        let over = |min, max| {
            PiecewiseConstant1D::new(&[1e38])?
                .over(min, max)
                .map(|_| ())
        };
        assert_eq!(over(1.0, 0.0), Err(TableError::Domain), "inverted");
        assert_eq!(over(0.0, 1e38), Err(TableError::Overflow), "integral");
        let adopt = |t: &[f32]| PiecewiseConstant1D::from_table(t, 1.0).map(|_| ());
        assert_eq!(
            adopt(&[1.0, 0.0, 0.5]),
            Err(TableError::Malformed),
            "does not end at 1"
        );
        assert_eq!(
            adopt(&[0.0, 0.0, 1.0]),
            Err(TableError::Malformed),
            "no density"
        );
    }
}
