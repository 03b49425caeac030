use std::path::{Path, PathBuf};

use crate::{PartialPicture, ToneMap};
use light_scene::{ChannelFile, Image, write_exr, write_exr_half, write_png};
use lights::glam::Vec3;

use super::failure::Failure;
use super::output_file::{expect_writable, has_ending, refuse};

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
        let format = if has_ending(path, "exr") {
            Format::Exr(precision)
        } else if has_ending(path, "png") {
            Format::Png
        } else {
            let message = "expected a file name that ends in .exr or .png";
            return Err(refuse(path, message));
        };
        expect_writable(path)?;
        Ok(Self {
            path: path.to_path_buf(),
            format,
        })
    }

    /// Where it is.
    pub(crate) fn path(&self) -> &Path {
        &self.path
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

    /// Whether it can hold layers.
    pub(crate) const fn has_layers(&self) -> bool {
        matches!(self.format, Format::Exr(_))
    }

    /// Writes a picture and its layers, by their names: channels `R`, `G`, `B` and `NAME.R` and so
    /// on of 32 bits, and the picture alone into a PNG.
    ///
    /// # Errors
    /// When the file cannot be written; nothing is left behind then.
    pub(crate) fn write_layers(
        &self,
        image: &Image,
        layers: &[(String, Vec<Vec3>)],
        tone_map: &ToneMap,
    ) -> Result<(), Failure> {
        if !self.has_layers() {
            return self.write(image, tone_map);
        }
        let mut channels = channels("", image.texels());
        for (name, texels) in layers {
            channels.extend(self::channels(&format!("{name}."), texels));
        }
        let file = ChannelFile {
            width: image.width(),
            height: image.height(),
            channels,
            ..ChannelFile::default()
        };
        file.write(&self.path).map_err(Failure::input)
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

/// The three channels of a layer.
fn channels(prefix: &str, texels: &[Vec3]) -> Vec<(String, Vec<f32>)> {
    let channel = |(color, name)| {
        let numbers = texels.iter().map(|texel| texel[color]).collect();
        (format!("{prefix}{name}"), numbers)
    };
    ["R", "G", "B"]
        .into_iter()
        .enumerate()
        .map(channel)
        .collect()
}

/// What a screen shows of linear radiance.
pub(crate) fn shown(image: &Image, tone_map: &ToneMap) -> Result<Image, Failure> {
    let texels = image.texels().iter().map(|&t| tone_map.apply(t)).collect();
    Image::new(image.width(), image.height(), texels).map_err(Failure::input)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_are_matched_without_case() {
        let folder = std::env::temp_dir();
        let image = |name: &str| OutputImage::new(&folder.join(name), Precision::Single);
        assert!(image("a.EXR").is_ok_and(|image| image.has_layers()));
        assert!(image("a.Png").is_ok_and(|image| !image.has_layers()));
        assert!(image("a.exr.jpg").is_err(), "another kind");
    }
}
