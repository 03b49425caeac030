use super::Spectrum;
use crate::float::sqrt;

/// A smooth spectrum between 0 and 1: a sigmoid of a parabola in wavelength.
///
/// `s(p(x))` with `s(y) = 1/2 + y / (2 sqrt(1 + y^2))`, `p(x) = (c[2] x + c[1]) x + c[0]` and
/// `x = (lambda - 595 nm) / 235 nm`, which runs from -1 to 1: in this variable single precision is
/// enough for the steepest spectra, unlike in nanometres.
///
/// # Source
/// `[Jakob2019]`, section 3.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(C)]
pub struct SigmoidPolynomial {
    /// Coefficients of the parabola, the constant one first.
    pub c: [f32; 3],
}

impl SigmoidPolynomial {
    /// The constant spectrum `value`, in `[0, 1]`.
    #[must_use]
    pub fn constant(value: f32) -> Self {
        // Ends of the range are out of reach for a sigmoid, but not in single precision.
        let v = value.clamp(1e-9, 1.0 - 1e-7);
        Self {
            c: [(v - 0.5) / sqrt(v * (1.0 - v)), 0.0, 0.0],
        }
    }

    /// The coefficients of `lambda`: from -1 at 360 nm to 1 at 830 nm.
    #[inline]
    #[must_use]
    pub(super) fn normalize(lambda: f32) -> f32 {
        (lambda - 595.0) * (1.0 / 235.0)
    }

    #[inline]
    fn at(&self, x: f32) -> f32 {
        sigmoid((self.c[2] * x + self.c[1]) * x + self.c[0])
    }
}

impl Spectrum for SigmoidPolynomial {
    #[inline]
    fn eval(&self, lambda: f32) -> f32 {
        self.at(Self::normalize(lambda))
    }

    fn max_value(&self) -> f32 {
        let ends = self.at(-1.0).max(self.at(1.0));
        let vertex = -0.5 * self.c[1] / self.c[2];
        if vertex > -1.0 && vertex < 1.0 {
            ends.max(self.at(vertex))
        } else {
            ends
        }
    }
}

#[inline]
fn sigmoid(y: f32) -> f32 {
    0.5 + 0.5 * y / sqrt(1.0 + y * y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_constant() {
        for value in [0.0, 0.1, 0.5, 0.9, 1.0] {
            let s = SigmoidPolynomial::constant(value);
            for lambda in [360.0, 500.0, 830.0] {
                assert!((s.eval(lambda) - value).abs() < 1e-6, "{value} at {lambda}");
            }
        }
    }

    #[test]
    fn maximum_is_at_the_vertex_or_an_end() {
        for c in [
            [1.0, 0.5, -2.0],
            [0.0, 3.0, 0.0],
            [-1.0, 0.2, 4.0],
            [0.0, 5.0, -1.0],
            [0.0; 3],
        ] {
            let s = SigmoidPolynomial { c };
            let max = (0..=4700).fold(0.0, |max: f32, i| max.max(s.eval(360.0 + 0.1 * i as f32)));
            assert!((s.max_value() - max).abs() < 1e-5, "{c:?}: {max}");
        }
    }
}
