/// Why an asymmetry parameter is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AsymmetryError {
    /// `g` or `k` does not lie strictly between -1 and 1, where the phase function has a density.
    OutOfRange,
    /// `g` is so near to -1 or 1 that the approximation has no `k` for it.
    NoApproximation,
}

impl core::fmt::Display for AsymmetryError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::OutOfRange => {
                "the asymmetry of a phase function must lie between -1 and 1, both excluded"
            }
            Self::NoApproximation => {
                "the asymmetry that Schlick's phase function stands for must lie in [-0.938, 0.938]"
            }
        })
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
