use std::path::{Path, PathBuf};

use crate::{PartialPicture, ToneMap};
use light_scene::{Image, write_exr, write_exr_half, write_png};

use super::failure::Failure;
use super::output_file::{expect_writable, refuse};

/// The file that a picture will be written to, tried before the work whose result it will hold.
#[derive(Debug)]
pub(crate) struct OutputImage {
    path: PathBuf,
    format: Format,
}

#[derive(Clone, Copy, Debug)]
enum Format {
    Exr(Precision),
    Png,
}

/// The numbers of an EXR file.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Precision {
    /// 32 bits.
    Single,
    /// 16 bits.
    Half,
}

impl OutputImage {
    /// Makes sure that a picture can be written to `path`; nothing appears there yet.
    ///
    /// # Errors
    /// When the name ends otherwise than in .exr or .png, or the folder cannot be written to.
    pub(crate) fn new(path: &Path, precision: Precision) -> Result<Self, Failure> {
        let format = match path.extension().and_then(|ending| ending.to_str()) {
            Some("exr") => Format::Exr(precision),
            Some("png") => Format::Png,
            _ => {
                return Err(refuse(
                    path,
                    "expected a file name that ends in .exr or .png",
                ));
            }
        };
        expect_writable(path)?;
        Ok(Self {
            path: path.to_path_buf(),
            format,
        })
    }

    /// Writes a part of a picture with its exact sums.
    ///
    /// # Errors
    /// When the file is no EXR or cannot be written; nothing is left behind then.
    pub(crate) fn write_part(&self, part: &PartialPicture) -> Result<(), Failure> {
        self.expect_part()?;
        part.write(&self.path).map_err(Failure::input)
    }

    /// Makes sure that a part of a picture can be written.
    ///
    /// # Errors
    /// When the file is no EXR.
    pub(crate) fn expect_part(&self) -> Result<(), Failure> {
        match self.format {
            Format::Exr(_) => Ok(()),
            Format::Png => Err(refuse(&self.path, "expected .exr for a part of a picture")),
        }
    }

    /// Writes linear radiance: as it is into an EXR, with `tone_map` into a PNG.
    ///
    /// # Errors
    /// When the file cannot be written; nothing is left behind then.
    pub(crate) fn write(&self, image: &Image, tone_map: &ToneMap) -> Result<(), Failure> {
        match self.format {
            Format::Exr(Precision::Single) => write_exr(&self.path, image),
            Format::Exr(Precision::Half) => write_exr_half(&self.path, image),
            Format::Png => write_png(&self.path, &shown(image, tone_map)?),
        }
        .map_err(Failure::input)
    }
}

/// What a screen shows of linear radiance.
pub(crate) fn shown(image: &Image, tone_map: &ToneMap) -> Result<Image, Failure> {
    let texels = image.texels().iter().map(|&t| tone_map.apply(t)).collect();
    Image::new(image.width(), image.height(), texels).map_err(Failure::input)
}
