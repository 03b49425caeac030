use light_math::float::ONE_MINUS_EPSILON;
use light_math::glam::Vec2;

use crate::{Estimate, Rng};

/// The random numbers of a query at a point of the unit square, all of them below 1.
pub(super) fn place_in_square(u: [f64; 2]) -> Vec2 {
    Vec2::from(u.map(|u| (u as f32).min(ONE_MINUS_EPSILON)))
}

/// An integral of `N` numbers, each with the standard error that pairs of points in equal cells
/// have.
///
/// The two values of a cell are independent, so that a quarter of their squared difference is an
/// unbiased estimate of the variance of their mean, however much cells differ from one another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stratified<const N: usize> {
    sum: [f64; N],
    variance: [f64; N],
}

impl<const N: usize> Default for Stratified<N> {
    fn default() -> Self {
        Self {
            sum: [0.0; N],
            variance: [0.0; N],
        }
    }
}

impl<const N: usize> Stratified<N> {
    /// Adds a cell, by two independent estimates of its integral.
    pub(super) fn add_cell(&mut self, [a, b]: [[f64; N]; 2]) {
        for i in 0..N {
            self.sum[i] += 0.5 * (a[i] + b[i]);
            self.variance[i] += 0.25 * (a[i] - b[i]).powi(2);
        }
    }

    /// The integral of `value` over the unit square, by two points in each of `side` by `side`
    /// cells.
    pub(super) fn over_square(
        side: u32,
        rng: &mut Rng,
        mut value: impl FnMut([f64; 2], &mut Rng) -> [f64; N],
    ) -> Self {
        let mut integral = Self::default();
        let width = 1.0 / f64::from(side);
        for cell in 0..side * side {
            let low = [cell % side, cell / side].map(|i| f64::from(i) * width);
            integral.add_cell([(); 2].map(|()| {
                let at = low.map(|low| low + width * rng.f64());
                value(at, rng).map(|value| value * width * width)
            }));
        }
        integral
    }

    /// Adds an independent integral.
    pub(super) fn add(&mut self, other: &Self) {
        for i in 0..N {
            self.sum[i] += other.sum[i];
            self.variance[i] += other.variance[i];
        }
    }

    /// The same numbers times `factor`.
    pub(super) fn scaled(mut self, factor: f64) -> Self {
        for i in 0..N {
            self.sum[i] *= factor;
            self.variance[i] *= factor * factor;
        }
        self
    }

    pub(super) const fn values(&self) -> [f64; N] {
        self.sum
    }

    /// How far chance may move the difference between this and an independent integral.
    pub(super) fn margin(&self, other: &Self) -> [f64; N] {
        core::array::from_fn(|i| {
            Estimate::STANDARD_ERRORS * (self.variance[i] + other.variance[i]).sqrt()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_those_that_are_stated() {
        let mut rng = Rng::new(1);
        let mut squares = 0.0;
        let rounds = 400;
        for _ in 0..rounds {
            let integral = Stratified::over_square(8, &mut rng, |[x, y], _| [x.exp() * y]);
            let off = integral.values()[0] - 0.5 * (1f64.exp() - 1.0);
            squares += off * off / integral.variance[0];
        }
        let ratio = squares / f64::from(rounds);
        assert!((0.8..1.25).contains(&ratio), "{ratio}");
    }
}
