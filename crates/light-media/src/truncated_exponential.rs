use light_math::float::{exp, ln};

/// Distances from 0 to `length` with density in proportion to `exp(-rate x)`, as the transmittance
/// of a homogeneous medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TruncatedExponential {
    rate: f32,
    length: f32,
    /// The mass before normalisation, times the rate.
    mass: f32,
}

impl TruncatedExponential {
    /// Below this optical thickness the density is nearly constant, and the formulas would lose
    /// digits by cancellation.
    const THIN: f32 = 1e-3;

    /// The distribution with `rate >= 0` over a finite `length > 0`.
    pub(crate) fn new(rate: f32, length: f32) -> Self {
        Self {
            rate,
            length,
            mass: 1.0 - exp(-rate * length),
        }
    }

    fn is_thin(&self) -> bool {
        !(self.rate * self.length > Self::THIN)
    }

    /// The distance for `u` in `[0, 1)`.
    pub(crate) fn sample(&self, u: f32) -> f32 {
        if self.is_thin() {
            u * self.length
        } else {
            (-ln(1.0 - u * self.mass) / self.rate).min(self.length)
        }
    }

    /// The density at a distance within the length.
    pub(crate) fn pdf(&self, x: f32) -> f32 {
        if self.is_thin() {
            1.0 / self.length
        } else {
            self.rate * exp(-self.rate * x) / self.mass
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_steps_of_u_hold_equal_mass() {
        for (rate, length) in [(0.0, 3.0), (1e-4, 2.0), (0.7, 5.0), (40.0, 3.0)] {
            let d = TruncatedExponential::new(rate, length);
            let n = 64u8;
            for i in 0..n {
                let ends = [i, i + 1].map(|i| d.sample(f32::from(i) / f32::from(n)));
                let middle = 0.5 * (ends[0] + ends[1]);
                let mass = (ends[1] - ends[0])
                    * (d.pdf(ends[0]) + 4.0 * d.pdf(middle) + d.pdf(ends[1]))
                    / 6.0;
                // Simpson's rule does not follow the last, unbounded step of a thick medium.
                assert!(
                    i == n - 1 || (mass * f32::from(n) - 1.0).abs() < 2e-2,
                    "rate {rate}: step {i} holds {mass}"
                );
            }
            assert!(d.sample(0.999_999_94) <= length, "within the length");
        }
    }

    #[test]
    fn thin_media_keep_their_digits() {
        for thickness in [1e-8, 1e-6, 1e-5, 5e-4] {
            let d = TruncatedExponential::new(thickness / 2.0, 2.0);
            for i in 1..32u8 {
                let u = f32::from(i) / 32.0;
                let error = d.sample(u) / (2.0 * u) - 1.0;
                assert!(error.abs() < 1e-3, "{thickness}: off by {error} at {u}");
            }
            assert!((d.pdf(1.0) * 2.0 - 1.0).abs() < 1e-3, "{thickness}");
        }
    }

    /// The last float below one represents the end, or by rounding for a place beyond it.
    #[test]
    fn samples_stay_within_the_length() {
        let mut beyond = 0;
        for i in 0..4000u16 {
            let rate = 0.01 + 0.001 * f32::from(i);
            let d = TruncatedExponential::new(rate, 3.0);
            let u = light_math::float::ONE_MINUS_EPSILON;
            beyond += u32::from(-ln(1.0 - u * d.mass) / rate > 3.0);
            assert!(d.sample(u) <= 3.0, "rate {rate}");
        }
        assert!(beyond > 10, "{beyond} samples need the guard");
    }
}
