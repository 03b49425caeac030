use alloc::vec;
use alloc::vec::Vec;

use light_math::float;

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

/// The weight of the value at each angle in the exact integral of the linear interpolation over
/// the axis of these angles.
pub(super) fn axis_weights(angles: &[f32], measure: Measure) -> Vec<f64> {
    let mut weights = vec![0.0; angles.len()];
    for (i, pair) in angles.windows(2).enumerate() {
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
    fn weights_are_integrals_in_double_precision() {
        for (a, b) in [
            (0.0, 0.1),
            (10.0, 12.5),
            (0.0, 57.0),
            (0.0, 58.0),
            (0.0, 180.0),
            (90.0, 180.0),
        ] {
            let axis = [a, b];
            let [a, b] = [a, b].map(|degrees: f32| f64::from(degrees).to_radians());
            let mean = ((b).sin() - a.sin()) / (b - a);
            let expected = [a.cos() - mean, mean - b.cos()];
            for (weight, expected) in axis_weights(&axis, Measure::Colatitude)
                .iter()
                .zip(expected)
            {
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
        let axis = [0.0, 20.0, 90.0, 180.0];
        let sum = |measure| axis_weights(&axis, measure).iter().sum::<f64>();
        assert!(
            (sum(Measure::Longitude) - core::f64::consts::PI).abs() < 1e-6,
            "pi"
        );
        assert!((sum(Measure::Colatitude) - 2.0).abs() < 1e-6, "1 - cos pi");
        let half = [-90.0, 0.0, 90.0];
        let sum: f64 = axis_weights(&half, Measure::Latitude).iter().sum();
        assert!((sum - 2.0).abs() < 1e-6, "from pole to pole");
    }
}
