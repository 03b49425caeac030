use core::error::Error;
use core::fmt;

/// Why numbers are no image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ImageError {
    /// Width or height is 0.
    Empty,
    /// There are not `width * height * channels` numbers.
    Length,
    /// An image that is to be an equal-area map is not square.
    NotSquare,
    /// A texel is NaN.
    NotANumber {
        /// Its column and row.
        texel: [u32; 2],
        /// Its channel: 0 red or grey, 1 green, 2 blue.
        channel: usize,
    },
    /// A texel is infinite.
    Infinite {
        /// Its column and row.
        texel: [u32; 2],
        /// Its channel: 0 red or grey, 1 green, 2 blue.
        channel: usize,
    },
    /// A texel is below 0. Readers of files are expected to clamp and to say so.
    Negative {
        /// Its column and row.
        texel: [u32; 2],
        /// Its channel: 0 red or grey, 1 green, 2 blue.
        channel: usize,
    },
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (texel, channel, rule) = match self {
            Self::Empty => return f.write_str("width and height must be at least 1"),
            Self::Length => return f.write_str("width * height * channels numbers are needed"),
            Self::NotSquare => return f.write_str("an equal-area image must be square"),
            Self::NotANumber { texel, channel } => (texel, channel, "is not a number"),
            Self::Infinite { texel, channel } => (texel, channel, "is infinite"),
            Self::Negative { texel, channel } => (texel, channel, "is negative"),
        };
        write!(
            f,
            "texel ({}, {}), channel {channel}: {rule}",
            texel[0], texel[1]
        )
    }
}

impl Error for ImageError {}
