use crate::significance;

/// The mean of random numbers, with its statistical tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Mean of the numbers.
    pub mean: f64,
    /// Standard error of the mean.
    pub standard_error: f64,
}

impl Estimate {
    /// How many standard errors a mean may be off: a normal variable is further away with the
    /// chance [`SIGNIFICANCE`](crate::SIGNIFICANCE).
    pub const STANDARD_ERRORS: f64 = 6.14;

    /// Relative error that the arithmetic in `f32` may add.
    pub const ROUNDING: f64 = 1e-4;

    /// The mean of `n` independent numbers, at least two.
    pub fn of(n: u32, mut draw: impl FnMut() -> f64) -> Self {
        significance::take();
        // Welford's update: no cancellation, however small the variance.
        let (mut mean, mut squares) = (0.0, 0.0);
        for i in 1..=n {
            let x = draw();
            let delta = x - mean;
            mean += delta / f64::from(i);
            squares += delta * (x - mean);
        }
        let n = f64::from(n);
        Self {
            mean,
            standard_error: (squares / (n * (n - 1.0))).sqrt(),
        }
    }

    /// Tolerance of the difference between the mean and `truth`.
    #[must_use]
    pub fn margin(&self, truth: f64) -> f64 {
        Self::STANDARD_ERRORS * self.standard_error + Self::ROUNDING * truth.abs()
    }

    /// Whether the mean is as near to `truth` as chance and rounding allow; never when it is NaN.
    #[must_use]
    pub fn agrees_with(&self, truth: f64) -> bool {
        (self.mean - truth).abs() <= self.margin(truth)
    }

    /// Whether two independent estimates may have the same mean; never when one is NaN.
    #[must_use]
    pub fn agrees_with_estimate(&self, other: &Self) -> bool {
        let standard_error = self.standard_error.hypot(other.standard_error);
        let mean = other.mean;
        let difference = Self {
            standard_error,
            ..*self
        };
        difference.agrees_with(mean)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    #[test]
    fn means_agree_with_the_truth_and_not_with_another() {
        let mut rng = Rng::new(6);
        let estimate = Estimate::of(10_000, || rng.f64());
        let expected = (1.0 / 12f64).sqrt() / 100.0;
        assert!(
            (estimate.standard_error / expected - 1.0).abs() < 0.05,
            "{estimate:?}"
        );
        assert!(
            estimate.agrees_with(0.5) && !estimate.agrees_with(0.525),
            "{estimate:?}"
        );
    }

    #[test]
    fn the_margin_is_that_of_the_level() {
        let tail = |x: f64| crate::chi_squared_survival(1, x * x);
        let errors = Estimate::STANDARD_ERRORS;
        assert!(tail(errors) <= crate::SIGNIFICANCE, "{}", tail(errors));
        assert!(tail(errors - 0.02) > crate::SIGNIFICANCE, "no larger");
    }

    #[test]
    fn two_estimates_agree_or_not() {
        let mut rng = Rng::new(7);
        let [a, b] = [(); 2].map(|()| Estimate::of(10_000, || rng.f64()));
        let shifted = Estimate::of(10_000, || rng.f64() + 0.03);
        assert!(a.agrees_with_estimate(&b), "{a:?} {b:?}");
        assert!(!a.agrees_with_estimate(&shifted), "{a:?} {shifted:?}");
    }

    #[test]
    fn nan_agrees_with_nothing() {
        assert!(!Estimate::of(10, || f64::NAN).agrees_with(0.0), "NaN");
    }
}
