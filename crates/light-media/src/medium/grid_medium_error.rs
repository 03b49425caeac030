use crate::region::RegionError;

/// Why a medium of grids is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GridMediumError {
    /// Of its box.
    Region(RegionError),
    /// The largest extinction of the samples is not finite.
    SigmaT,
    /// The largest emission of the samples is not finite.
    Emission,
}

impl GridMediumError {
    /// Checks upper bounds of extinction and emission. Interpolation rounds them up a little, so
    /// that twice as much has to be a number.
    pub(super) fn check(max_sigma_t: f32, max_emission: f32) -> Result<(), Self> {
        let fits = |bound: f32| (2.0 * bound).is_finite();
        match (fits(max_sigma_t), fits(max_emission)) {
            (false, _) => Err(Self::SigmaT),
            (true, false) => Err(Self::Emission),
            (true, true) => Ok(()),
        }
    }
}

impl From<RegionError> for GridMediumError {
    fn from(error: RegionError) -> Self {
        Self::Region(error)
    }
}

impl core::fmt::Display for GridMediumError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Region(error) => error.fmt(f),
            Self::SigmaT => f.write_str("the extinction of a grid must be finite"),
            Self::Emission => f.write_str("the emission of a grid must be finite"),
        }
    }
}

impl core::error::Error for GridMediumError {}
