use super::Spectrum;
use super::integrals::SpectrumIntegrals;
use super::visible_range::{LAMBDA_MAX, LAMBDA_MIN};
use crate::float;

/// A spectrum by values at chosen wavelengths, straight between them and 0 outside.
///
/// `S` is an array, a borrowed slice or a `Vec`. A query costs a binary search. A line of its own
/// wavelength alone has no width and therefore no power.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PiecewiseLinear<S> {
    lambdas: S,
    values: S,
}

impl<S: AsRef<[f32]>> PiecewiseLinear<S> {
    /// The spectrum whose value at `lambdas[i]` nm, in strictly increasing order, is `values[i]`.
    ///
    /// # Errors
    /// If there are no values or not as many as wavelengths, if the wavelengths do not increase, or
    /// if a number is not finite.
    pub fn new(lambdas: S, values: S) -> Result<Self, PiecewiseLinearError> {
        let (x, y) = (lambdas.as_ref(), values.as_ref());
        if x.is_empty() {
            return Err(PiecewiseLinearError::Empty);
        }
        if x.len() != y.len() {
            return Err(PiecewiseLinearError::LengthMismatch);
        }
        if !x.iter().chain(y).all(|v| v.is_finite()) {
            return Err(PiecewiseLinearError::NotFinite);
        }
        if !x.windows(2).all(|pair| pair[0] < pair[1]) {
            return Err(PiecewiseLinearError::NotIncreasing);
        }
        Ok(Self { lambdas, values })
    }

    /// The wavelengths, in increasing order.
    #[must_use]
    pub fn lambdas(&self) -> &[f32] {
        self.lambdas.as_ref()
    }

    /// The value at each of the wavelengths.
    #[must_use]
    pub fn values(&self) -> &[f32] {
        self.values.as_ref()
    }
}

impl<S: AsRef<[f32]>> Spectrum for PiecewiseLinear<S> {
    fn eval(&self, lambda: f32) -> f32 {
        let (x, y) = (self.lambdas.as_ref(), self.values.as_ref());
        // The first wavelength above; NaN is above none and below none.
        let above = x.partition_point(|&l| l <= lambda);
        if above == 0 {
            return 0.0;
        }
        let below = above - 1;
        if above == x.len() {
            return if lambda == x[below] { y[below] } else { 0.0 };
        }
        straight(lambda, [x[below], x[above]], [y[below], y[above]])
    }

    fn max_value(&self) -> f32 {
        self.values
            .as_ref()
            .iter()
            .fold(f32::NEG_INFINITY, |a, &b| a.max(b))
    }

    /// Exact, however narrow the lines.
    fn integrals(&self) -> SpectrumIntegrals {
        let mut sum = SpectrumIntegrals::default();
        let (x, y) = (self.lambdas().windows(2), self.values().windows(2));
        for (x, y) in x.zip(y) {
            let (x, y) = ([x[0], x[1]], [y[0], y[1]]);
            let (mut from, end) = (x[0].max(LAMBDA_MIN), x[1].min(LAMBDA_MAX));
            while from < end {
                let to = end.min(float::floor(from) + 1.0);
                sum.add_straight([from, to], [from, to].map(|lambda| straight(lambda, x, y)));
                from = to;
            }
        }
        sum
    }
}

/// The value at `lambda` of the straight line from `x[0]` to `x[1]`.
fn straight(lambda: f32, x: [f32; 2], y: [f32; 2]) -> f32 {
    let t = (lambda - x[0]) / (x[1] - x[0]);
    (1.0 - t) * y[0] + t * y[1]
}

/// Why numbers are no piecewise linear spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PiecewiseLinearError {
    /// There are no wavelengths.
    Empty,
    /// There are not as many values as wavelengths.
    LengthMismatch,
    /// A wavelength is not above the one before it.
    NotIncreasing,
    /// A wavelength or value is infinite or not a number.
    NotFinite,
}

impl core::fmt::Display for PiecewiseLinearError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Empty => "a piecewise linear spectrum has at least one wavelength",
            Self::LengthMismatch => "a spectrum has as many values as wavelengths",
            Self::NotIncreasing => "a spectrum's wavelengths increase strictly",
            Self::NotFinite => "a spectrum's wavelength or value is not finite",
        })
    }
}

impl core::error::Error for PiecewiseLinearError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_straight_between_and_zero_outside() {
        let s = PiecewiseLinear::new([400.0, 500.0, 700.0], [1.0, 3.0, 0.0]).expect("valid");
        for (lambda, expected) in [
            (399.9, 0.0),
            (400.0, 1.0),
            (450.0, 2.0),
            (500.0, 3.0),
            (600.0, 1.5),
            (700.0, 0.0),
            (700.1, 0.0),
            (f32::NAN, 0.0),
        ] {
            assert_eq!(s.eval(lambda), expected, "at {lambda}");
        }
        assert_eq!(s.max_value(), 3.0, "bound");
        let numbers = (s.lambdas(), s.values());
        assert_eq!(
            numbers,
            (&[400.0, 500.0, 700.0][..], &[1.0, 3.0, 0.0][..]),
            "as given"
        );
    }

    /// Triangles of height 1; the integrals by the efficiency at whole nanometres.
    #[test]
    fn narrow_lines_have_their_power() {
        for (middle, half, luminous) in [
            (555.0, 0.1, 68.3),
            (554.5, 0.1, 68.3),
            (589.3, 0.6, 314.1),
            (589.0, 1e-3, 0.525),
        ] {
            let lambdas = [middle - half, middle, middle + half];
            let line = PiecewiseLinear::new(lambdas, [0.0, 1.0, 0.0]).expect("valid");
            let SpectrumIntegrals {
                luminous: l,
                radiant,
                ..
            } = line.integrals();
            // The ends are whole steps of 6e-5 nm.
            let given = 0.5 * (lambdas[2] - lambdas[0]);
            assert!(
                (radiant / given - 1.0).abs() < 1e-5,
                "{middle}: {radiant} W"
            );
            let expected = luminous * given / half;
            assert!((l / expected - 1.0).abs() < 2e-3, "{middle}: {l} lm");
        }
    }

    #[test]
    fn integrals_are_those_of_other_spectra() {
        use crate::spectrum::Constant;
        let flat = PiecewiseLinear::new([100.0, 500.3, 2e3], [2.0; 3]).expect("valid");
        let (flat, constant) = (flat.integrals(), Constant(2.0).integrals());
        assert!((flat.radiant / constant.radiant - 1.0).abs() < 1e-5, "W");
        assert!((flat.luminous / constant.luminous - 1.0).abs() < 1e-5, "lm");
        let infrared = PiecewiseLinear::new([900.0, 1e3], [1.0; 2]).expect("valid");
        assert_eq!(infrared.integrals(), SpectrumIntegrals::default(), "unseen");
    }

    #[test]
    fn one_wavelength_is_a_line() {
        let s = PiecewiseLinear::new([589.0], [2.0]).expect("valid");
        assert_eq!(s.integrals().radiant, 0.0, "without width");
        assert_eq!((s.eval(589.0), s.eval(589.1)), (2.0, 0.0), "sodium");
    }

    #[test]
    fn every_rule_is_checked() {
        let new = |x: &'static [f32], y: &'static [f32]| PiecewiseLinear::new(x, y).err();
        assert_eq!(new(&[], &[]), Some(PiecewiseLinearError::Empty), "empty");
        assert_eq!(
            new(&[1.0], &[]),
            Some(PiecewiseLinearError::LengthMismatch),
            "lengths"
        );
        assert_eq!(
            new(&[1.0, 1.0], &[0.0, 0.0]),
            Some(PiecewiseLinearError::NotIncreasing),
            "order"
        );
        assert_eq!(
            new(&[1.0], &[f32::INFINITY]),
            Some(PiecewiseLinearError::NotFinite),
            "finite"
        );
        assert_eq!(
            new(&[f32::NAN], &[0.0]),
            Some(PiecewiseLinearError::NotFinite),
            "NaN"
        );
    }
}
