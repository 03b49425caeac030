use crate::glam::Vec3;

/// A sum of colours in double precision, for the millions of texels of an image.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RgbSum([f64; 3]);

impl RgbSum {
    /// Adds `rgb`, `weight` times.
    pub(crate) fn add(&mut self, rgb: Vec3, weight: f64) {
        for (sum, channel) in self.0.iter_mut().zip(rgb.to_array()) {
            *sum += weight * f64::from(channel);
        }
    }

    /// Adds another sum, `weight` times.
    pub(crate) fn add_sum(&mut self, other: &Self, weight: f64) {
        for (sum, channel) in self.0.iter_mut().zip(other.0) {
            *sum += weight * channel;
        }
    }

    /// The sum divided by `total`, rounded to single precision; zero if `total` is
    /// zero.
    pub(crate) fn over(&self, total: f64) -> Vec3 {
        if total > 0.0 {
            Vec3::from_array(self.0.map(|sum| single(sum / total)))
        } else {
            Vec3::ZERO
        }
    }
}

/// The nearest single-precision number.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding is what it is for"
)]
pub(crate) const fn single(x: f64) -> f32 {
    x as f32
}
