use core::array::from_fn;
use core::iter::Sum;
use core::ops::{
    Add, AddAssign, Div, DivAssign, Index, IndexMut, Mul, MulAssign, Neg, Sub, SubAssign,
};

/// The values of a spectrum at the `N` wavelengths of a path, with arithmetic value by value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct SampledSpectrum<const N: usize>([f32; N]);

impl<const N: usize> SampledSpectrum<N> {
    /// Zero at all wavelengths.
    pub const ZERO: Self = Self([0.0; N]);

    /// One at all wavelengths.
    pub const ONE: Self = Self([1.0; N]);

    /// The given values.
    #[inline]
    #[must_use]
    pub const fn new(values: [f32; N]) -> Self {
        Self(values)
    }

    /// The same value at all wavelengths.
    #[inline]
    #[must_use]
    pub const fn splat(value: f32) -> Self {
        Self([value; N])
    }

    /// The values.
    #[inline]
    #[must_use]
    pub const fn values(&self) -> &[f32; N] {
        &self.0
    }

    /// `f` of each value.
    #[inline]
    #[must_use]
    pub fn map(self, f: impl FnMut(f32) -> f32) -> Self {
        Self(self.0.map(f))
    }

    /// `f` of each pair of values.
    #[inline]
    #[must_use]
    pub fn zip(self, other: Self, mut f: impl FnMut(f32, f32) -> f32) -> Self {
        Self(from_fn(|i| f(self.0[i], other.0[i])))
    }

    /// Whether all values are 0.
    #[inline]
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.iter().all(|&v| v == 0.0)
    }

    /// Whether all values are finite.
    #[inline]
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.0.iter().all(|v| v.is_finite())
    }

    /// The mean of the values; 0 when there are none.
    #[inline]
    #[must_use]
    pub fn average(&self) -> f32 {
        self.0.iter().sum::<f32>() / (N.max(1)) as f32
    }

    /// The largest value; negative infinity when there are none.
    #[inline]
    #[must_use]
    pub fn max_element(&self) -> f32 {
        self.0.iter().fold(f32::NEG_INFINITY, |a, &b| a.max(b))
    }

    /// The smallest value; infinity when there are none.
    #[inline]
    #[must_use]
    pub fn min_element(&self) -> f32 {
        self.0.iter().fold(f32::INFINITY, |a, &b| a.min(b))
    }

    /// The quotients, 0 where the divisor is 0.
    #[inline]
    #[must_use]
    pub fn safe_div(self, divisor: Self) -> Self {
        self.zip(divisor, |a, b| if b == 0.0 { 0.0 } else { a / b })
    }

    /// `e` to the power of each value.
    #[inline]
    #[must_use]
    pub fn exp(self) -> Self {
        self.map(crate::float::exp)
    }

    /// The mix of `self` (at `t` = 0) and `other` (at `t` = 1).
    #[inline]
    #[must_use]
    pub fn lerp(self, other: Self, t: f32) -> Self {
        self * (1.0 - t) + other * t
    }
}

impl<const N: usize> Default for SampledSpectrum<N> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const N: usize> Index<usize> for SampledSpectrum<N> {
    type Output = f32;

    #[inline]
    fn index(&self, i: usize) -> &f32 {
        &self.0[i]
    }
}

impl<const N: usize> IndexMut<usize> for SampledSpectrum<N> {
    #[inline]
    fn index_mut(&mut self, i: usize) -> &mut f32 {
        &mut self.0[i]
    }
}

impl<const N: usize> Add for SampledSpectrum<N> {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<const N: usize> Sub for SampledSpectrum<N> {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for SampledSpectrum<N> {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<const N: usize> Div for SampledSpectrum<N> {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl<const N: usize> Mul<f32> for SampledSpectrum<N> {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f32) -> Self {
        self.map(|v| v * factor)
    }
}

impl<const N: usize> Mul<SampledSpectrum<N>> for f32 {
    type Output = SampledSpectrum<N>;

    #[inline]
    fn mul(self, spectrum: SampledSpectrum<N>) -> SampledSpectrum<N> {
        spectrum * self
    }
}

impl<const N: usize> Div<f32> for SampledSpectrum<N> {
    type Output = Self;

    #[inline]
    fn div(self, divisor: f32) -> Self {
        self.map(|v| v / divisor)
    }
}

impl<const N: usize> Neg for SampledSpectrum<N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.map(|v| -v)
    }
}

impl<const N: usize> AddAssign for SampledSpectrum<N> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> SubAssign for SampledSpectrum<N> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<const N: usize> MulAssign for SampledSpectrum<N> {
    #[inline]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<const N: usize> MulAssign<f32> for SampledSpectrum<N> {
    #[inline]
    fn mul_assign(&mut self, factor: f32) {
        *self = *self * factor;
    }
}

impl<const N: usize> DivAssign<f32> for SampledSpectrum<N> {
    #[inline]
    fn div_assign(&mut self, divisor: f32) {
        *self = *self / divisor;
    }
}

impl<const N: usize> Sum for SampledSpectrum<N> {
    fn sum<I: Iterator<Item = Self>>(spectra: I) -> Self {
        spectra.fold(Self::ZERO, Add::add)
    }
}

#[cfg(test)]
mod tests;
