use alloc::vec;
use alloc::vec::Vec;

use light_math::float;

/// Ascending angles in degrees of measured values, with linear interpolation between them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis(Vec<f32>);

/// Weights of linear interpolation: `1 - t` for the value at index `below`, `t` for the one at
/// index `above`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Between {
    pub(super) below: usize,
    pub(super) above: usize,
    pub(super) t: f32,
}

/// The factor of an axis in the solid angle of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    /// The step itself: around a pole.
    Longitude,
    /// The step times the sine of the angle: away from a pole.
    Colatitude,
    /// The step times the cosine of the angle: away from an equator.
    Latitude,
}

impl Axis {
    /// An axis of at least one angle; `None` if they do not ascend.
    pub(super) fn new(angles: Vec<f32>) -> Option<Self> {
        let ascend = angles.windows(2).all(|pair| pair[0] < pair[1]);
        (ascend && !angles.is_empty()).then_some(Self(angles))
    }

    pub(super) fn angles(&self) -> &[f32] {
        &self.0
    }

    pub(super) fn first(&self) -> f32 {
        self.0[0]
    }

    pub(super) fn last(&self) -> f32 {
        self.0[self.0.len() - 1]
    }

    /// The interpolation at `degrees`; `None` beyond the ends, with a margin for rounding.
    pub(super) fn place(&self, degrees: f32) -> Option<Between> {
        const ROUNDING: f32 = 1e-3;
        if !(degrees >= self.first() - ROUNDING && degrees <= self.last() + ROUNDING) {
            return None;
        }
        let last = self.0.len() - 1;
        let above = self
            .0
            .partition_point(|&angle| angle <= degrees)
            .clamp(1.min(last), last);
        let below = above.saturating_sub(1);
        let step = self.0[above] - self.0[below];
        let t = if step > 0.0 {
            ((degrees - self.0[below]) / step).clamp(0.0, 1.0)
        } else {
            0.0
        };
        Some(Between { below, above, t })
    }

    /// The weight of the value at each angle in the exact integral of the linear interpolation over
    /// the axis.
    pub(super) fn weights(&self, measure: Measure) -> Vec<f64> {
        let mut weights = vec![0.0; self.0.len()];
        for (i, pair) in self.0.windows(2).enumerate() {
            let middle = (0.5 * (pair[0] + pair[1])).to_radians();
            let half = (0.5 * (pair[1] - pair[0])).to_radians();
            let (sin, cos) = float::sin_cos(middle);
            let (low, high) = match measure {
                Measure::Longitude => (half, half),
                Measure::Colatitude => sine_weights(sin, cos, half),
                Measure::Latitude => sine_weights(cos, -sin, half),
            };
            weights[i] += f64::from(low);
            weights[i + 1] += f64::from(high);
        }
        weights
    }
}

/// The same angle in `[0, 360)` degrees.
pub(super) fn full_turn(degrees: f32) -> f32 {
    let rest = degrees % 360.0;
    if rest < 0.0 { rest + 360.0 } else { rest }
}

/// The integrals of the sine times the linear functions that fall and rise between 0 and 1, over
/// the angles from `half` before to `half` after the angle with this `sin` and `cos`; `half` is at
/// most a right angle.
///
/// The integral of the sine is `2 sin sin(half)`, its first moment about the middle
/// `2 cos (sin(half) - half cos(half))`.
fn sine_weights(sin: f32, cos: f32, half: f32) -> (f32, f32) {
    let (sin_half, cos_half) = float::sin_cos(half);
    let tilt = if half < 0.5 {
        // The difference of the two terms would lose digits: the first terms of its series, by
        // Horner's rule.
        let x = half * half;
        x * (1.0 / 3.0 - x * (1.0 / 30.0 - x * (1.0 / 840.0 - x * (1.0 / 45_360.0))))
    } else {
        sin_half / half - cos_half
    };
    let (mean, tilt) = (sin * sin_half, cos * tilt);
    (mean - tilt, mean + tilt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_between_or_nowhere() {
        let axis = Axis::new(vec![0.0, 10.0, 40.0]).expect("ascending");
        let at = |degrees| axis.place(degrees).map(|p| (p.below, p.above, p.t));
        assert_eq!(at(0.0), Some((0, 1, 0.0)), "the first");
        assert_eq!(at(25.0), Some((1, 2, 0.5)), "between");
        assert_eq!(at(40.0), Some((1, 2, 1.0)), "the last");
        assert_eq!(at(41.0), None, "beyond");
        assert_eq!(at(f32::NAN), None, "nowhere");
        let single = Axis::new(vec![0.0]).expect("one");
        assert_eq!(single.place(0.0).map(|p| p.above), Some(0), "one angle");
        assert_eq!(Axis::new(vec![1.0, 1.0]), None, "equal");
    }

    #[test]
    fn weights_are_integrals_in_double_precision() {
        for (a, b) in [
            (0.0, 0.1),
            (10.0, 12.5),
            (0.0, 57.0),
            (0.0, 58.0),
            (0.0, 180.0),
            (90.0, 180.0),
        ] {
            let axis = Axis::new(vec![a, b]).expect("ascending");
            let [a, b] = [a, b].map(|degrees: f32| f64::from(degrees).to_radians());
            let mean = ((b).sin() - a.sin()) / (b - a);
            let expected = [a.cos() - mean, mean - b.cos()];
            for (weight, expected) in axis.weights(Measure::Colatitude).iter().zip(expected) {
                let error = (weight - expected).abs();
                assert!(
                    error <= 1e-6 * expected,
                    "{a} to {b}: {weight} for {expected}"
                );
            }
        }
    }

    #[test]
    fn weights_of_a_constant_are_the_measure() {
        let axis = Axis::new(vec![0.0, 20.0, 90.0, 180.0]).expect("ascending");
        let sum = |measure| axis.weights(measure).iter().sum::<f64>();
        assert!(
            (sum(Measure::Longitude) - core::f64::consts::PI).abs() < 1e-6,
            "pi"
        );
        assert!((sum(Measure::Colatitude) - 2.0).abs() < 1e-6, "1 - cos pi");
        let half = Axis::new(vec![-90.0, 0.0, 90.0]).expect("ascending");
        let sum: f64 = half.weights(Measure::Latitude).iter().sum();
        assert!((sum - 2.0).abs() < 1e-6, "from pole to pole");
    }
}
