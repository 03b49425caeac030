use core::ops::Range;
use std::path::PathBuf;

use crate::{Film, PartialPicture, ToneMap};
use clap::Args;
use light_scene::Image;

use super::failure::Failure;
use super::output_file::expect_another;
use super::output_image::{OutputImage, Precision};
use super::stdout::complain;

/// Put parts of a picture together that were rendered with --samples.
#[derive(Args, Debug)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  lights merge part-0.exr part-1.exr -o whole.exr"
)]
pub(crate) struct MergeArgs {
    /// The parts, in any order.
    #[arg(required = true)]
    parts: Vec<PathBuf>,
    /// The image to write: .exr (float32 linear RGB) or .png.
    #[arg(short, long, value_name = "IMAGE")]
    output: PathBuf,
    /// Write a part again, with the samples of all, between which none may be missing.
    #[arg(long)]
    part: bool,
}

/// What parts add up to.
enum Sum {
    Picture(Film),
    Part(PartialPicture),
}

impl MergeArgs {
    /// Reads the parts, adds them up, and writes the picture: the same bits as if it had been
    /// rendered at once.
    ///
    /// # Errors
    /// Parts that cannot be read or do not belong together; an output that cannot be written.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let output = OutputImage::new(&self.output, Precision::Single)?;
        if self.part {
            output.expect_part()?;
        }
        expect_another(&self.output, &self.parts, "a part for --output")?;
        let mut unread = Ok(());
        let mut last = &self.output;
        let mut ranges = Vec::new();
        let parts = self.parts.iter().map_while(|path| {
            last = path;
            PartialPicture::read(path)
                .inspect(|part| ranges.push(part.samples.clone()))
                .map_err(|error| unread = Err(error))
                .ok()
        });
        let sum = if self.part {
            PartialPicture::join(parts).map(Sum::Part)
        } else {
            PartialPicture::merge(parts).map(Sum::Picture)
        };
        unread.map_err(Failure::input)?;
        let sum = sum.map_err(|error| Failure::Input(format!("{}: {error}", last.display())))?;
        let film = match sum {
            Sum::Part(part) => return output.write_part(&part),
            Sum::Picture(film) => film,
        };
        for gap in gaps(ranges) {
            complain(format_args!(
                "warning: the samples {}..{} are in no part; the picture is the mean of the others",
                gap.start, gap.end
            ));
        }
        let (width, height) = film.resolution();
        let image = Image::new(width, height, film.develop()).map_err(Failure::input)?;
        output.write(&image, &ToneMap::fit(image.texels()))
    }
}

/// The samples before the last that are in none of `ranges`.
fn gaps(mut ranges: Vec<Range<u32>>) -> Vec<Range<u32>> {
    ranges.sort_by_key(|range| range.start);
    let mut gaps = Vec::new();
    let mut end = 0;
    for range in ranges {
        if range.start > end {
            gaps.push(end..range.start);
        }
        end = end.max(range.end);
    }
    gaps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_between_parts_and_before_the_first() {
        assert_eq!(gaps(vec![3..5, 0..3]), [], "in any order");
        assert_eq!(gaps(vec![7..9, 2..5]), [0..2, 5..7], "two");
        assert_eq!(gaps(vec![]), [], "no part");
    }
}
