use std::path::Path;

use super::broken_texels::BrokenTexels;
use super::image_file::ending;
use super::openexr::parse_exr_with;
use super::pfm::parse_pfm;
use super::radiance::parse_hdr;
use super::{EncodedImage, Encoding, Image, ImageFile, write_exr, write_hdr, write_png};
use crate::{Diagnostic, Files};

/// The endings of the names of images that are read.
pub(crate) const IMAGE_ENDINGS: &str = ".exr, .hdr, .pfm, .png, .tga or .jpg";

/// Reads an image by the ending of its name: `.exr` (channels R, G, B, or Y), `.hdr`, `.pfm`, or
/// `.png`, `.tga`, `.jpg`, `.jpeg` (sRGB, made linear). Negative texels become 0, with a warning.
/// Texels of `.hdr` are divided by the exposure in the header, with a warning where it is not 1.
///
/// # Errors
/// When the file cannot be read, is broken or of another kind, lacks a channel, or holds a NaN or
/// an infinity: with the pixel and the channel.
pub fn read_image(path: &Path) -> Result<ImageFile, Diagnostic> {
    expect_image_name(path)?;
    parse_image(path, &Files::DISK.read(path)?)
}

/// As [`read_image`], with negative texels as they are in the file: what pictures are compared by.
///
/// # Errors
/// As [`read_image`].
pub fn read_signed_image(path: &Path) -> Result<ImageFile, Diagnostic> {
    expect_image_name(path)?;
    let bytes = Files::DISK.read(path)?;
    parse_with(path, &bytes, Encoding::Srgb, BrokenTexels::KeepNegative)
}

/// Makes sure that the ending of a name is that of an image.
pub(crate) fn expect_image_name(path: &Path) -> Result<(), Diagnostic> {
    if !is_image_name(path) {
        let message = format!("expected an image: {IMAGE_ENDINGS}");
        return Err(Diagnostic::file(path, message));
    }
    Ok(())
}

/// As [`read_image`], for an image that gives light from all around: where at most one of a hundred
/// texels is NaN or infinite, these become 0 or the largest number of the image, and the warning
/// counts them.
///
/// # Errors
/// As [`read_image`], but for such texels.
pub fn read_environment(path: &Path) -> Result<ImageFile, Diagnostic> {
    read_environment_from(path, Files::DISK)
}

/// As [`read_environment`], with the bytes from `files`.
pub(crate) fn read_environment_from(
    path: &Path,
    files: Files<'_>,
) -> Result<ImageFile, Diagnostic> {
    expect_image_name(path)?;
    parse_with(
        path,
        &files.read(path)?,
        Encoding::Srgb,
        BrokenTexels::Clamp,
    )
}

/// As [`read_image`], from the bytes of the file; `path` says by its ending which format they have,
/// and names them in messages.
///
/// # Errors
/// As [`read_image`].
pub fn parse_image(path: &Path, bytes: &[u8]) -> Result<ImageFile, Diagnostic> {
    parse_encoded(path, bytes, Encoding::Srgb)
}

/// As [`parse_image`]; `encoding` says what the numbers of files mean that are made for screens.
pub(crate) fn parse_encoded(
    path: &Path,
    bytes: &[u8],
    encoding: Encoding,
) -> Result<ImageFile, Diagnostic> {
    parse_with(path, bytes, encoding, BrokenTexels::Refuse)
}

fn parse_with(
    path: &Path,
    bytes: &[u8],
    encoding: Encoding,
    broken: BrokenTexels,
) -> Result<ImageFile, Diagnostic> {
    match ending(path).as_str() {
        "exr" => parse_exr_with(path, bytes, broken),
        "hdr" => parse_hdr(path, bytes, broken),
        "pfm" => parse_pfm(path, bytes, broken),
        _ => Ok(ImageFile {
            image: EncodedImage::parse(path, bytes)?.color(encoding),
            warning: None,
        }),
    }
}

/// How opaque an image says that a surface is: by the alpha channel of a PNG file that has one, by
/// the brightness of others, alike in all channels.
pub(crate) fn parse_opacity(path: &Path, bytes: &[u8]) -> Result<ImageFile, Diagnostic> {
    if matches!(ending(path).as_str(), "exr" | "hdr" | "pfm") {
        return parse_image(path, bytes);
    }
    let encoded = EncodedImage::parse(path, bytes)?;
    Ok(ImageFile {
        image: encoded.alpha().unwrap_or_else(|| encoded.brightness()),
        warning: None,
    })
}

/// Whether [`read_image`] reads files whose name ends so.
pub(crate) fn is_image_name(path: &Path) -> bool {
    matches!(
        ending(path).as_str(),
        "exr" | "hdr" | "pfm" | "png" | "tga" | "jpg" | "jpeg"
    )
}

/// Writes an image by the ending of its name: `.exr` (float32 linear RGB), `.hdr` (RGBE) or `.png`
/// (8-bit sRGB).
///
/// # Errors
/// When the ending is another, or the file cannot be written; nothing is left behind then.
pub fn write_image(path: &Path, image: &Image) -> Result<(), Diagnostic> {
    match ending(path).as_str() {
        "exr" => write_exr(path, image),
        "hdr" => write_hdr(path, image),
        "png" => write_png(path, image),
        _ => Err(Diagnostic::file(
            path,
            "expected an image to write: .exr, .hdr or .png",
        )),
    }
}
