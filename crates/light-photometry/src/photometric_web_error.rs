use core::error::Error;
use core::fmt;

/// Why angles and candelas are invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PhotometricWebError {
    /// Vertical angles do not ascend in `[0, 180]`, or for types A and B from the opposite of the
    /// last one, or from 0, to at most 90; or there is only one.
    Vertical,
    /// Horizontal angles do not ascend from 0 to 0, 90, 180 or a number above 180 up to 360, or
    /// from 90 to 270, or for types A and B from the opposite of the last one, or from 0, to at
    /// most 90; or there is only one in these types.
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
                "expected ascending horizontal angles from 0 to 0, 90, 180 or above 180 up to 360, \
                 or from 90 to 270, in types A and B from -90 or 0 to 90"
            }
            Self::Candelas => "expected a finite intensity of at least 0 for each pair of angles",
        })
    }
}

impl Error for PhotometricWebError {}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use alloc::string::ToString;

    use super::*;
    use crate::{PhotometricWeb, WebType};

    #[test]
    fn the_ends_that_are_named_are_those_that_are_taken() {
        let web = |end| PhotometricWeb::new(WebType::C, &[0.0, 90.0], &[0.0, end], &[1.0; 4]);
        for end in [90.0, 180.0, 180.5, 270.0, 330.0, 360.0] {
            assert!(web(end).is_ok(), "from 0 to {end}");
        }
        for end in [45.0, 179.0, 361.0] {
            let error = web(end).expect_err("no symmetry");
            assert_eq!(error, PhotometricWebError::Horizontal, "from 0 to {end}");
            let said = error.to_string();
            assert!(said.contains("0, 90, 180 or above 180 up to 360"), "{said}");
        }
    }
}
