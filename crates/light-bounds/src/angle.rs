use core::ops::Sub;

use light_math::float::sqrt;

/// An angle in `[0, pi]` by its sine and cosine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Angle {
    pub(crate) sin: f32,
    pub(crate) cos: f32,
}

impl Angle {
    const ZERO: Self = Self { sin: 0.0, cos: 1.0 };

    #[inline]
    pub(crate) fn from_cos(cos: f32) -> Self {
        Self {
            sin: sqrt((1.0 - cos) * (1.0 + cos)),
            cos,
        }
    }

    /// The acute angle.
    #[inline]
    pub(crate) fn from_sin(sin: f32) -> Self {
        Self {
            sin,
            cos: sqrt((1.0 - sin) * (1.0 + sin)),
        }
    }
}

impl Sub for Angle {
    type Output = Self;

    /// The difference, at least 0.
    #[inline]
    fn sub(self, other: Self) -> Self {
        if self.cos > other.cos {
            return Self::ZERO;
        }
        Self {
            sin: (self.sin * other.cos - self.cos * other.sin).max(0.0),
            cos: self.cos * other.cos + self.sin * other.sin,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_of_angles() {
        let [small, large] = [0.3f32, 1.1].map(|a| Angle::from_cos(a.cos()));
        let difference = large - small;
        assert!((difference.cos - 0.8f32.cos()).abs() < 1e-6, "cosine");
        assert!((difference.sin - 0.8f32.sin()).abs() < 1e-6, "sine");
        assert_eq!((small - large).cos, 1.0, "at least zero");
        let same = Angle::from_sin(0.3f32.sin());
        assert!((same.cos - 0.3f32.cos()).abs() < 1e-6, "by either");
    }
}
