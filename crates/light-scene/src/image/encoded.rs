use std::path::Path;

use ::image::{DynamicImage, ImageFormat};

use super::image_file::ending;
use super::{Image, display::decode, srgb};
use crate::Diagnostic;
use crate::glam::Vec3;

/// The transfer function of the numbers in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Encoding {
    /// The sRGB curve.
    Srgb,
    /// Linear.
    Linear,
    /// A power function.
    Gamma(f32),
}

/// An image as screens want it, of a PNG, TGA or JPEG file: colours are encoded by sRGB, data stand
/// for themselves.
#[derive(Clone, Debug)]
pub(crate) struct EncodedImage(DynamicImage);

impl EncodedImage {
    /// The image in the bytes of a file; `path` names it in messages.
    pub(crate) fn parse(path: &Path, bytes: &[u8]) -> Result<Self, Diagnostic> {
        let (format, what) = match bytes {
            [0xff, 0xd8, ..] => (ImageFormat::Jpeg, "a JPEG file"),
            // Files of this kind have no mark of their own.
            _ if ending(path) == "tga" => (ImageFormat::Tga, "a TGA file"),
            [0x89, b'P', ..] => (ImageFormat::Png, "a PNG file"),
            _ if matches!(&*ending(path), "jpg" | "jpeg") => (ImageFormat::Jpeg, "a JPEG file"),
            _ => (ImageFormat::Png, "a PNG file"),
        };
        let image = decode(path, bytes, format, what)?;
        if image.width() == 0 || image.height() == 0 {
            return Err(Diagnostic::file(
                path,
                "expected an image of at least one pixel",
            ));
        }
        Ok(Self(image))
    }

    /// Texels per row, and rows.
    pub(crate) fn size(&self) -> [u32; 2] {
        [self.0.width(), self.0.height()]
    }

    /// The colours, made linear.
    pub(crate) fn color(&self, encoding: Encoding) -> Image {
        let image = self.0.to_rgb16();
        let linear = |channel| encoding.decode(part(channel));
        let texels = image.pixels().map(|texel| texel.0.map(linear).into());
        self.of_texels(texels.collect())
    }

    /// How opaque each texel is, alike in all channels; `None` if all are so.
    pub(crate) fn alpha(&self) -> Option<Image> {
        if !self.0.color().has_alpha() {
            return None;
        }
        let image = self.0.to_rgba16();
        let texels: Vec<Vec3> = image
            .pixels()
            .map(|texel| Vec3::splat(part(texel.0[3])))
            .collect();
        let has_holes = texels.iter().any(|&texel| texel != Vec3::ONE);
        has_holes.then(|| self.of_texels(texels))
    }

    /// How bright each texel is as it is written, alike in all channels.
    pub(crate) fn brightness(&self) -> Image {
        let image = self.0.to_luma16();
        let texels = image.pixels().map(|texel| Vec3::splat(part(texel.0[0])));
        self.of_texels(texels.collect())
    }

    fn of_texels(&self, texels: Vec<Vec3>) -> Image {
        let image = Image::new(self.0.width(), self.0.height(), texels);
        image.expect("as many texels as the image has")
    }
}

impl Encoding {
    fn decode(self, encoded: f32) -> f32 {
        match self {
            Self::Srgb => srgb::decode(encoded),
            Self::Linear => encoded,
            Self::Gamma(power) => encoded.powf(power),
        }
    }
}

/// The part of its largest value that a channel holds.
fn part(channel: u16) -> f32 {
    f32::from(channel) / 65535.0
}
