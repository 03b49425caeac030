//! Radiance HDR, PNG and JPEG.

use std::io::Cursor;
use std::path::Path;

use ::image::codecs::hdr::HdrEncoder;
use ::image::codecs::png::PngEncoder;
use ::image::{DynamicImage, ExtendedColorType, ImageEncoder, ImageFormat, ImageReader, Rgb};

use super::broken_texels::BrokenTexels;
use super::checked::checked;
use super::cut_off::in_words;
use super::{Image, ImageFile};
use crate::glam::Vec3;
use crate::{Diagnostic, write_atomically};

/// The image in the bytes of a Radiance HDR (RGBE) file; `path` names it in messages.
pub(super) fn parse_hdr(
    path: &Path,
    bytes: &[u8],
    broken: BrokenTexels,
) -> Result<ImageFile, Diagnostic> {
    let signed = with_signature(bytes);
    let bytes = signed.as_deref().unwrap_or(bytes);
    let image = decode(path, bytes, ImageFormat::Hdr, "a Radiance HDR file")?.into_rgb32f();
    let size = [image.width() as usize, image.height() as usize];
    let texels = image.pixels().map(|texel| Vec3::from(texel.0)).collect();
    checked(path, size, texels, broken)
}

/// The bytes of a Radiance HDR file with the first line that the decoder expects, if it has another:
/// programs write their names there, most often `#?RGBE`.
fn with_signature(bytes: &[u8]) -> Option<Vec<u8>> {
    const SIGNATURE: &[u8] = b"#?RADIANCE";
    if !bytes.starts_with(b"#?") || bytes.starts_with(SIGNATURE) {
        return None;
    }
    let line = bytes.iter().position(|&byte| byte == b'\n');
    let rest = &bytes[line.unwrap_or(bytes.len())..];
    Some([SIGNATURE, rest].concat())
}

/// Writes an 8-bit sRGB PNG file; channels are clamped to [0, 1], NaN becomes black.
///
/// # Errors
/// When the file cannot be written; nothing is left behind then.
pub fn write_png(path: &Path, image: &Image) -> Result<(), Diagnostic> {
    write_atomically(path, &encode_png(path, image)?)
}

/// The bytes of an 8-bit sRGB PNG file, as [`write_png`] writes them; `path` names it in messages.
///
/// # Errors
/// When the image cannot be encoded.
pub fn encode_png(path: &Path, image: &Image) -> Result<Vec<u8>, Diagnostic> {
    let encoded = image.to_srgb();
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new(&mut bytes);
    let (width, height) = (image.width(), image.height());
    let written = encoder.write_image(
        encoded.as_flattened(),
        width,
        height,
        ExtendedColorType::Rgb8,
    );
    written.map_err(|error| Diagnostic::file(path, format!("cannot be written: {error}")))?;
    Ok(bytes)
}

/// Writes a Radiance HDR (RGBE) file: 8 bits a channel under a common exponent.
///
/// # Errors
/// When the file cannot be written; nothing is left behind then.
pub(crate) fn write_hdr(path: &Path, image: &Image) -> Result<(), Diagnostic> {
    let texels: Vec<Rgb<f32>> = image.texels().iter().map(|t| Rgb(t.to_array())).collect();
    let mut bytes = Vec::new();
    let (width, height) = (image.width() as usize, image.height() as usize);
    let written = HdrEncoder::new(&mut bytes).encode(&texels, width, height);
    written.map_err(|error| Diagnostic::file(path, format!("cannot be written: {error}")))?;
    write_atomically(path, &bytes)
}

/// Decodes an image, if it is not too large for the decoder's limits.
pub(super) fn decode(
    path: &Path,
    bytes: &[u8],
    format: ImageFormat,
    what: &str,
) -> Result<DynamicImage, Diagnostic> {
    let decoded = ImageReader::with_format(Cursor::new(bytes), format).decode();
    decoded
        .map_err(|error| Diagnostic::file(path, format!("expected {what}: {}", in_words(&error))))
}
