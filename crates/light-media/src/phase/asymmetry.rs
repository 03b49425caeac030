/// Why an asymmetry parameter is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AsymmetryError {
    /// `g` or `k` does not lie strictly between -1 and 1, where the phase function has a density.
    OutOfRange,
}

impl core::fmt::Display for AsymmetryError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("the asymmetry of a phase function must lie between -1 and 1, both excluded")
    }
}

impl core::error::Error for AsymmetryError {}

/// `x` if it lies strictly between -1 and 1.
pub(super) fn check_asymmetry(x: f32) -> Result<f32, AsymmetryError> {
    if x > -1.0 && x < 1.0 {
        Ok(x)
    } else {
        Err(AsymmetryError::OutOfRange)
    }
}
