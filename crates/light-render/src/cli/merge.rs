use std::path::PathBuf;

use crate::{Film, PartialPicture, ToneMap};
use clap::Args;
use light_scene::Image;

use super::failure::Failure;
use super::output_file::expect_another;
use super::output_image::{OutputImage, Precision};

/// Put parts of a picture together that were rendered with --samples.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lights merge part-0.exr part-1.exr -o whole.exr")]
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
        let parts = self.parts.iter().map_while(|path| {
            last = path;
            PartialPicture::read(path)
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
        let (width, height) = film.resolution();
        let image = Image::new(width, height, film.develop()).map_err(Failure::input)?;
        output.write(&image, &ToneMap::fit(image.texels()))
    }
}
