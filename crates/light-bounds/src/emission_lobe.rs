use core::f32::consts::PI;

use crate::glam::Vec3;

/// The emission of a point light, by moments of its intensity over all directions.
///
/// A cone bounds the directions of emission; the moments describe how power is distributed over
/// them: a projected picture that is bright in one corner, the beam of a measured luminaire.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EmissionLobe {
    /// Emitted power: the integral of the intensity, in W or the same multiple of it as the powers
    /// of the other lights.
    pub power: f32,
    /// Mean of the unit vectors away from the light, weighted by intensity: zero for an isotropic
    /// light, a unit vector for a ray.
    pub mean: Vec3,
    /// Root mean square, weighted by intensity, of the difference between the intensity and that
    /// of the [`line`](Self::line), divided by the peak of the line.
    pub spread: f32,
}

/// An intensity that is a linear function of the cosine to an axis.
///
/// Toward a unit vector `w` it is `peak * max(0, dot(axis, w) - offset)`, and `peak` along the
/// axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmissionLine {
    /// The largest intensity, in W·sr⁻¹.
    pub peak: f32,
    /// Direction of the peak; a longer axis means a narrower lobe.
    pub axis: Vec3,
    /// Subtracted from the cosine; below 0 if the lobe is wider than a right angle.
    pub offset: f32,
}

impl EmissionLobe {
    /// Excess over 1 that rounding may give the squared length of a mean of unit vectors.
    pub(crate) const LENGTH_TOLERANCE: f32 = 1e-3;

    /// Least width of a beam, as one minus a cosine.
    const MIN_WIDTH: f32 = 1e-4;

    /// Whether the moments are valid.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        let amount = |x: f32| x >= 0.0 && x.is_finite();
        amount(self.power)
            && amount(self.spread)
            && self.mean.length_squared() <= 1.0 + Self::LENGTH_TOLERANCE
    }

    /// The line that has the same power and the same mean direction.
    ///
    /// With `l` the length of the mean, a line that ends at the cosine `c` has `l = (2 + c) / 3`
    /// and the power `pi (1 - c) peak`. Below `l = 1 / 3` it covers all directions:
    /// `power / (4 pi) (1 + 3 l cos)`, as in the first band of spherical harmonics.
    #[must_use]
    pub fn line(&self) -> EmissionLine {
        let length = self.mean.length().min(1.0);
        if length <= 1.0 / 3.0 {
            let inv_peak = 1.0 / (1.0 + 3.0 * length);
            return EmissionLine {
                peak: self.power / (4.0 * PI * inv_peak),
                axis: self.mean * (3.0 * inv_peak),
                offset: -inv_peak,
            };
        }
        let width = (3.0 * (1.0 - length)).max(Self::MIN_WIDTH);
        EmissionLine {
            peak: (self.power / (PI * width)).min(f32::MAX),
            axis: self.mean / (length * width),
            offset: 1.0 / width - 1.0,
        }
    }
}

impl EmissionLine {
    /// The intensity toward the unit vector `w`, divided by the peak.
    #[must_use]
    pub fn relative_intensity(&self, w: Vec3) -> f32 {
        (self.axis.dot(w) - self.offset).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lobe(length: f32) -> EmissionLobe {
        EmissionLobe {
            power: 2.0,
            mean: Vec3::Y * length,
            spread: 0.0,
        }
    }

    #[test]
    fn a_line_has_the_power_and_the_mean_of_its_lobe() {
        for length in [0.0, 0.1, 1.0 / 3.0, 0.34, 0.5, 0.8, 0.99] {
            let line = lobe(length).line();
            let steps = 200_000u32;
            let (mut power, mut along) = (0.0, 0.0);
            for i in 0..steps {
                let cos = 2.0 * (f64::from(i) + 0.5) / f64::from(steps) - 1.0;
                let slope = f64::from(line.axis.y);
                let relative = (slope * cos - f64::from(line.offset)).max(0.0);
                let weight = 4.0 * core::f64::consts::PI / f64::from(steps);
                power += f64::from(line.peak) * relative * weight;
                along += f64::from(line.peak) * relative * cos * weight;
            }
            assert!((power - 2.0).abs() < 1e-3, "{length}: {power}");
            let mean = along / power;
            assert!((mean - f64::from(length)).abs() < 1e-3, "{length}: {mean}");
            let peak = line.relative_intensity(Vec3::Y);
            assert!((peak - 1.0).abs() < 1e-4, "{length}: {peak} on the axis");
        }
    }

    #[test]
    fn a_ray_has_a_finite_line() {
        for length in [0.999_999, 1.0, 1.0001] {
            let line = lobe(length).line();
            assert!(line.peak.is_finite(), "{line:?}");
            assert!(line.axis.is_finite() && line.offset.is_finite(), "{line:?}");
            assert_eq!(line.relative_intensity(Vec3::X), 0.0, "aside");
        }
    }

    #[test]
    fn moments_of_no_light_are_refused() {
        let good = lobe(0.5);
        assert!(good.is_valid(), "a lobe");
        for power in [-1.0, f32::NAN, f32::INFINITY] {
            assert!(!EmissionLobe { power, ..good }.is_valid(), "{power} W");
        }
        for spread in [-1.0, f32::NAN] {
            assert!(!EmissionLobe { spread, ..good }.is_valid(), "{spread}");
        }
        assert!(!lobe(1.1).is_valid(), "a mean beyond the unit sphere");
    }
}
