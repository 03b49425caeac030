//! PNG and JPEG.

use std::io::Cursor;
use std::path::Path;

use ::image::codecs::png::PngEncoder;
use ::image::{DynamicImage, ExtendedColorType, ImageEncoder, ImageFormat, ImageReader};

use super::Image;
use super::cut_off::in_words;
use crate::{Diagnostic, write_atomically};

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
