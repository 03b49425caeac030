use glam::Vec2;

use super::Spectrum;
use super::cie::{LAMBDA_MIN, OBSERVER, SAMPLES, Y_INTEGRAL};

/// The mean daylight and its two directions of change, from 360 to 830 nm at steps of 10 nm.
///
/// # Source
/// `[CIE015]`, table T.2.
#[rustfmt::skip]
const COMPONENTS: &[[f32; 3]; 48] = &[
    [61.5, 38.0, 5.3], [68.8, 42.4, 6.1], [63.4, 38.5, 3.0], [65.8, 35.0, 1.2],
    [94.8, 43.4, -1.1], [104.8, 46.3, -0.5], [105.9, 43.9, -0.7], [96.8, 37.1, -1.2],
    [113.9, 36.7, -2.6], [125.6, 35.9, -2.9], [125.5, 32.6, -2.8], [121.3, 27.9, -2.6],
    [121.3, 24.3, -2.6], [113.5, 20.1, -1.8], [113.1, 16.2, -1.5], [110.8, 13.2, -1.3],
    [106.5, 8.6, -1.2], [108.8, 6.1, -1.0], [105.3, 4.2, -0.5], [104.4, 1.9, -0.3],
    [100.0, 0.0, 0.0], [96.0, -1.6, 0.2], [95.1, -3.5, 0.5], [89.1, -3.5, 2.1],
    [90.5, -5.8, 3.2], [90.3, -7.2, 4.1], [88.4, -8.6, 4.7], [84.0, -9.5, 5.1],
    [85.1, -10.9, 6.7], [81.9, -10.7, 7.3], [82.6, -12.0, 8.6], [84.9, -14.0, 9.8],
    [81.3, -13.6, 10.2], [71.9, -12.0, 8.3], [74.3, -13.3, 9.6], [76.4, -12.9, 8.5],
    [63.3, -10.6, 7.0], [71.7, -11.6, 7.6], [77.0, -12.2, 8.0], [65.2, -10.2, 6.7],
    [47.7, -7.8, 5.2], [68.6, -11.2, 7.4], [65.0, -10.4, 6.8], [66.0, -10.6, 7.0],
    [61.0, -9.7, 6.4], [53.3, -8.3, 5.5], [58.9, -9.3, 6.1], [61.9, -9.8, 6.5],
];

/// A phase of daylight (a CIE D illuminant), scaled to the luminance `Y` = 1.
#[doc(alias = "D65")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Daylight {
    /// Weights of the three components.
    weights: [f32; 3],
}

impl Daylight {
    /// Noon daylight, about 6504 K: the white of sRGB, DCI-P3 and Rec. 2020 displays.
    pub const D65: Self = Self::from_weights(-0.295, -0.689);

    /// Afternoon daylight, about 5003 K: the white of print.
    pub const D50: Self = Self::from_weights(-1.039, 0.363);

    /// The white of ACES, about 6000 K: the mix of the components that has its chromaticity,
    /// (0.32168, 0.33767).
    pub const ACES_D60: Self = Self::from_weights(-0.535_934, -0.518_431);

    /// The daylight with the given correlated colour temperature.
    ///
    /// # Errors
    /// If the temperature is outside of 4000 to 25000 K, where the standard defines none.
    ///
    /// # Source
    /// `[CIE015]`, section 3.1.
    pub fn from_temperature(kelvin: f32) -> Result<Self, DaylightError> {
        if !(4000.0..=25_000.0).contains(&kelvin) {
            return Err(DaylightError::Temperature);
        }
        let t = 1000.0 / kelvin;
        let x = if kelvin <= 7000.0 {
            ((-4.6070 * t + 2.9678) * t + 0.099_11) * t + 0.244_063
        } else {
            ((-2.0064 * t + 1.9018) * t + 0.247_48) * t + 0.237_040
        };
        let y = (-3.0 * x + 2.870) * x - 0.275;
        let m = 0.0241 + 0.2562 * x - 0.7341 * y;
        Ok(Self::from_weights(
            (-1.3515 - 1.7703 * x + 5.9114 * y) / m,
            (0.0300 - 31.4424 * x + 30.0717 * y) / m,
        ))
    }

    /// CIE 1931 chromaticity `(x, y)`.
    #[must_use]
    pub fn chromaticity(&self) -> Vec2 {
        let xyz = super::cie::xyz(self);
        Vec2::new(xyz.x, xyz.y) / xyz.element_sum()
    }

    /// The mean daylight plus the given shares of the two directions, scaled to `Y` = 1.
    const fn from_weights(m1: f32, m2: f32) -> Self {
        let unscaled = Self {
            weights: [1.0, m1, m2],
        };
        let mut y = 0.0;
        let mut i = 0;
        while i < SAMPLES {
            y += unscaled.at(i / 10, (i % 10) as f32 * 0.1) * OBSERVER[i].y;
            i += 1;
        }
        let scale = Y_INTEGRAL / y;
        Self {
            weights: [scale, m1 * scale, m2 * scale],
        }
    }

    /// The value at fraction `t` of the way from row `i` of the table to the next.
    #[inline]
    const fn at(&self, i: usize, t: f32) -> f32 {
        let next = if i < 47 { i + 1 } else { 47 };
        let (a, b) = (COMPONENTS[i], COMPONENTS[next]);
        let w = self.weights;
        (1.0 - t) * (w[0] * a[0] + w[1] * a[1] + w[2] * a[2])
            + t * (w[0] * b[0] + w[1] * b[1] + w[2] * b[2])
    }
}

impl Spectrum for Daylight {
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and 47"
    )]
    fn eval(&self, lambda: f32) -> f32 {
        let position = (lambda - LAMBDA_MIN) * 0.1;
        if !(0.0..=47.0).contains(&position) {
            return 0.0;
        }
        let i = position as usize;
        self.at(i, position - i as f32)
    }

    fn max_value(&self) -> f32 {
        (0..COMPONENTS.len()).fold(0.0, |max, i| self.at(i, 0.0).max(max))
    }
}

/// Why a daylight is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DaylightError {
    /// The temperature is not between 4000 and 25000 K.
    Temperature,
}

impl core::fmt::Display for DaylightError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Temperature => "daylight has a colour temperature from 4000 to 25000 K",
        })
    }
}

impl core::error::Error for DaylightError {}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values of a reference renderer, which normalises alike.
    #[test]
    fn d65_at_four_wavelengths() {
        let d65 = Daylight::D65;
        for (lambda, expected) in [
            (450.0, 1.183_213_83),
            (550.0, 1.052_138_92),
            (600.0, 0.910_165_012),
            (650.0, 0.809_250_832),
        ] {
            let value = d65.eval(lambda);
            assert!(
                (value / expected - 1.0f32).abs() < 1e-5,
                "{value} at {lambda}"
            );
        }
    }

    #[test]
    fn chromaticities_of_the_standards() {
        for (daylight, x, y) in [
            (Daylight::D65, 0.312_72, 0.329_03),
            (Daylight::D50, 0.345_67, 0.358_51),
            (Daylight::ACES_D60, 0.321_68, 0.337_67),
        ] {
            let xy = daylight.chromaticity();
            assert!(xy.distance(Vec2::new(x, y)) < 1e-4, "{xy}");
        }
    }

    #[test]
    fn luminance_is_one() {
        for kelvin in [4000.0, 5003.0, 6504.0, 7000.0, 7001.0, 25_000.0] {
            let d = Daylight::from_temperature(kelvin).expect("valid");
            let y = crate::spectrum::cie::xyz(&d).y;
            assert!((y - 1.0).abs() < 1e-5, "{kelvin} K: {y}");
            assert!(d.max_value() >= d.eval(460.0), "bound");
        }
        let near = Daylight::from_temperature(6504.0).expect("valid");
        assert!(
            (near.eval(450.0) - Daylight::D65.eval(450.0)).abs() < 2e-3,
            "D65"
        );
    }

    #[test]
    fn nothing_outside_of_the_range() {
        for lambda in [359.0, 831.0, f32::NAN] {
            assert_eq!(Daylight::D65.eval(lambda), 0.0, "{lambda}");
        }
        for kelvin in [3999.0, 25_001.0, f32::NAN] {
            assert_eq!(
                Daylight::from_temperature(kelvin),
                Err(DaylightError::Temperature),
                "{kelvin}"
            );
        }
    }
}
