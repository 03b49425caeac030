use super::Spectrum;

/// The same value at every wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Constant(pub f32);

impl Spectrum for Constant {
    #[inline]
    fn eval(&self, _lambda: f32) -> f32 {
        self.0
    }

    #[inline]
    fn max_value(&self) -> f32 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::SampledWavelengths;

    #[test]
    fn is_the_same_everywhere() {
        let w = SampledWavelengths::<4>::uniform(0.3);
        assert_eq!(Constant(2.0).sample(&w).values(), &[2.0; 4], "samples");
        assert_eq!(Constant(2.0).max_value(), 2.0, "bound");
    }
}
