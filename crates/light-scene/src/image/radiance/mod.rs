//! Radiance pictures (`.hdr`): texels of a common exponent.

mod write;

use std::io::Cursor;
use std::path::Path;

use ::image::codecs::hdr::{HdrDecoder, HdrMetadata};
use ::image::{DynamicImage, ImageError};
use exr::math::Vec2;
use exr::meta::attribute::Chromaticities;

use super::ImageFile;
use super::broken_texels::BrokenTexels;
use super::checked::checked;
use super::cut_off::in_words;
use super::primaries;
use crate::Diagnostic;
use crate::glam::Vec3;
use crate::text::shown;

pub(crate) use write::write_hdr;

/// The first line that the decoder expects.
const SIGNATURE: &[u8] = b"#?RADIANCE";

/// The most texels a byte of a file: a run of 127 takes two bytes for each of four components. What
/// has fewer texels than a small picture may be one run of the old kind.
const DENSEST: usize = 16;
const SMALL: usize = 1 << 22;

/// An exposure that is nearer to 1 is not worth a word: Radiance itself does not write it.
const EXPOSED: f32 = 0.01;

/// The image in the bytes of a Radiance picture of RGBE texels, row by row from the top; `path`
/// names it in messages.
///
/// The texels are radiance: divided by the exposure and the colour correction that the header says
/// they were multiplied by, with a warning where that is not 1, as some programs leave it out.
/// Colours of other primaries become those of Rec. 709.
///
/// # Source
/// `[Radiance]`, `color.c` and the page on file formats.
pub(super) fn parse_hdr(
    path: &Path,
    bytes: &[u8],
    broken: BrokenTexels,
) -> Result<ImageFile, Diagnostic> {
    let signed = with_signature(bytes);
    let bytes = signed.as_deref().unwrap_or(bytes);
    let unread = |error: ImageError| {
        let message = format!("expected a Radiance HDR file: {}", in_words(&error));
        Diagnostic::file(path, message)
    };
    let decoder = HdrDecoder::new(Cursor::new(bytes)).map_err(unread)?;
    let header = decoder.metadata();
    let size = [header.width as usize, header.height as usize];
    let [width, height] = size;
    let most = bytes.len().saturating_mul(DENSEST).max(SMALL);
    if width.saturating_mul(height) > most {
        let found = bytes.len();
        let message =
            format!("expected the texels of {width} x {height}, found {found} bytes in all");
        return Err(Diagnostic::file(path, message));
    }
    let exposure = exposure(path, &header)?;
    let to_rec_709 = chromaticities(path, &header)?.and_then(|file| primaries::to_rec_709(&file));
    let image = DynamicImage::from_decoder(decoder).map_err(unread)?;
    let texels = image.to_rgb32f();
    let mut texels: Vec<Vec3> = texels
        .pixels()
        .map(|t| Vec3::from(t.0) / exposure)
        .collect();
    if let Some(matrix) = to_rec_709 {
        primaries::convert(&mut texels, &matrix);
    }
    let mut file = checked(path, size, texels, broken)?;
    if !exposure.abs_diff_eq(Vec3::ONE, EXPOSED) {
        let by = if exposure == Vec3::splat(exposure.x) {
            exposure.x.to_string()
        } else {
            exposure.to_string()
        };
        let mut message = format!(
            "texels were divided by {by}, the exposure of the header: some programs leave this out"
        );
        if let Some(warning) = file.warning {
            message = format!("{message}; {}", warning.message);
        }
        file.warning = Some(Diagnostic::file(path, message));
    }
    Ok(file)
}

/// The bytes of a Radiance picture with the first line that the decoder expects, if it has another:
/// programs write their names there, most often `#?RGBE`.
fn with_signature(bytes: &[u8]) -> Option<Vec<u8>> {
    if !bytes.starts_with(b"#?") || bytes.starts_with(SIGNATURE) {
        return None;
    }
    let line = bytes.iter().position(|&byte| byte == b'\n');
    let rest = &bytes[line.unwrap_or(bytes.len())..];
    Some([SIGNATURE, rest].concat())
}

/// What the texels were multiplied by: the product of all exposures and colour corrections.
fn exposure(path: &Path, header: &HdrMetadata) -> Result<Vec3, Diagnostic> {
    let color = header.color_correction.map_or(Vec3::ONE, Vec3::from);
    let exposure = header.exposure.unwrap_or(1.0) * color;
    let is_usable =
        exposure.min_element() > 0.0 && exposure.is_finite() && exposure.recip().is_finite();
    is_usable.then_some(exposure).ok_or_else(|| {
        let found = exposure.min_element();
        let message = format!("expected a product of exposures above 0, found {found}");
        Diagnostic::file(path, message)
    })
}

/// The last `PRIMARIES` of the header.
fn chromaticities(path: &Path, header: &HdrMetadata) -> Result<Option<Chromaticities>, Diagnostic> {
    let attributes = header.custom_attributes.iter().rev();
    let mut primaries = attributes.filter(|(key, _)| key == "PRIMARIES");
    let Some((_, value)) = primaries.next() else {
        return Ok(None);
    };
    let words = value.split_whitespace().map(|word| word.parse().ok());
    let numbers = words.collect::<Option<Vec<f32>>>();
    let numbers = numbers.filter(|numbers| numbers.iter().all(|n| n.is_finite()));
    let Some([rx, ry, gx, gy, bx, by, wx, wy]) = numbers.as_deref() else {
        let found = shown(value);
        let message = format!(
            "expected `PRIMARIES=` and x, y of red, green, blue and white, found `{found}`"
        );
        return Err(Diagnostic::file(path, message));
    };
    Ok(Some(Chromaticities {
        red: Vec2(*rx, *ry),
        green: Vec2(*gx, *gy),
        blue: Vec2(*bx, *by),
        white: Vec2(*wx, *wy),
    }))
}

#[cfg(test)]
mod tests;
