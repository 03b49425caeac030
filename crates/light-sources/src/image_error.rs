use crate::channels::Channels;
use core::error::Error;
use core::fmt;

/// Why an image is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ImageError {
    /// Width or height is 0.
    Empty,
    /// There are not `width * height * channels` numbers.
    Length {
        /// So many are needed, or more than `usize` can hold: then it is its largest value.
        expected: usize,
        /// So many there are.
        found: usize,
    },
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
            Self::Length { expected, found } => {
                return write!(
                    f,
                    "expected width * height * channels = {expected} numbers, found {found}"
                );
            }
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

/// Checks `len` numbers, of which `number` returns each.
pub(crate) fn check_texels(
    size: [u32; 2],
    channels: Channels,
    len: usize,
    number: impl Fn(usize) -> f32,
) -> Result<(), ImageError> {
    if size.contains(&0) {
        return Err(ImageError::Empty);
    }
    let texels = (size[0] as usize).checked_mul(size[1] as usize);
    let numbers = texels.and_then(|texels| texels.checked_mul(channels.count()));
    let expected = numbers.unwrap_or(usize::MAX);
    if expected != len {
        return Err(ImageError::Length {
            expected,
            found: len,
        });
    }
    for i in 0..len {
        let value = number(i);
        if value >= 0.0 && value.is_finite() {
            continue;
        }
        let channel = i % channels.count();
        let i = i / channels.count();
        #[expect(clippy::cast_possible_truncation, reason = "both below a u32")]
        let texel = [(i % size[0] as usize) as u32, (i / size[0] as usize) as u32];
        return Err(if value.is_nan() {
            ImageError::NotANumber { texel, channel }
        } else if value < 0.0 {
            ImageError::Negative { texel, channel }
        } else {
            ImageError::Infinite { texel, channel }
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn a_wrong_count_of_numbers_is_said_beside_the_right_one() {
        let check = |size, len| check_texels(size, Channels::Rgb, len, |_| 1.0);
        assert_eq!(check([2, 3], 18), Ok(()), "as many as needed");
        let (expected, found) = (18, 17);
        let short = ImageError::Length { expected, found };
        assert_eq!(check([2, 3], found), Err(short), "too few");
        let words = "expected width * height * channels = 18 numbers, found 17";
        assert_eq!(short.to_string(), words, "both");
        let huge = check([u32::MAX; 2], 1);
        let expected = usize::MAX;
        let found = 1;
        assert_eq!(
            huge,
            Err(ImageError::Length { expected, found }),
            "beyond all"
        );
    }
}
