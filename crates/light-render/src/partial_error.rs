use core::error::Error;
use core::fmt;
use core::ops::Range;

/// Why pictures do not add up.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PartialPictureError {
    /// The file holds no sums: it was not rendered as a part.
    NoPart,
    /// The file is not as it was written.
    Damaged,
    /// The parts are not of one picture.
    OtherPicture {
        /// Where they differ.
        difference: String,
    },
    /// Two parts hold the same samples.
    Overlap {
        /// The samples of the later part.
        samples: Range<u32>,
    },
    /// Samples between those of the parts are missing.
    Gap {
        /// The first that are missing.
        samples: Range<u32>,
    },
    /// There is nothing to add.
    Nothing,
}

impl fmt::Display for PartialPictureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPart => {
                f.write_str("expected a picture rendered with --samples or a checkpoint")
            }
            Self::Damaged => f.write_str("is damaged: its bytes do not fit its checksum"),
            Self::OtherPicture { difference } => {
                write!(f, "expected a part of the same picture: {difference}")
            }
            Self::Overlap { samples } => {
                let Range { start, end } = samples;
                write!(f, "samples {start}..{end} are in another part too")
            }
            Self::Gap { samples } => {
                let Range { start, end } = samples;
                write!(f, "samples {start}..{end} are in no part")
            }
            Self::Nothing => f.write_str("expected at least one part"),
        }
    }
}

impl Error for PartialPictureError {}
