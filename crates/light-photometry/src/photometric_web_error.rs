use core::error::Error;
use core::fmt;

/// Why angles and candelas are invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PhotometricWebError {
    /// Vertical angles do not ascend in `[0, 180]`, or for types A and B from the opposite of the
    /// last one, or from 0, to at most 90; or there is only one.
    Vertical,
    /// Horizontal angles do not ascend from 0 to 0, 90, 180 or 360 or from 90 to 270, or for types
    /// A and B from the opposite of the last one, or from 0, to at most 90; or there is only one in
    /// these types.
    Horizontal,
    /// There is not one value for each pair of angles, or one is negative or not finite.
    Candelas,
}

impl fmt::Display for PhotometricWebError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Vertical => {
                "expected ascending vertical angles in [0, 180], in types A and B from -90 or 0 to 90"
            }
            Self::Horizontal => {
                "expected ascending horizontal angles from 0 to 0, 90, 180 or 360 or from 90 to 270, \
                 in types A and B from -90 or 0 to 90"
            }
            Self::Candelas => "expected a finite intensity of at least 0 for each pair of angles",
        })
    }
}

impl Error for PhotometricWebError {}
