use std::path::Path;

use ::image::Rgb;
use ::image::codecs::hdr::HdrEncoder;

use crate::glam::Vec3;
use crate::image::Image;
use crate::{Diagnostic, write_atomically};

/// 2^127, above what the largest exponent reaches.
const ABOVE_ALL: f32 = 1.701_411_8e38;

/// 255 times 2^119, the largest number.
const LARGEST: f32 = ABOVE_ALL * (255.0 / 256.0);

/// 2^-128, below which the least exponent does not reach.
const LEAST: f32 = f32::MIN_POSITIVE / 4.0;

/// Writes a Radiance HDR (RGBE) file: 8 bits a channel under a common exponent.
///
/// # Errors
/// When a texel is too bright for the format, or the file cannot be written; nothing is left behind
/// then.
pub(crate) fn write_hdr(path: &Path, image: &Image) -> Result<(), Diagnostic> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let texels = image.texels();
    let is_beyond = |texel: &Vec3| texel.max_element() >= ABOVE_ALL;
    if let Some(index) = texels.iter().position(is_beyond) {
        let (x, y, found) = (index % width, index / width, texels[index].max_element());
        let message = format!(
            "pixel ({x}, {y}): expected less than {ABOVE_ALL:e}, the most that .hdr files hold, \
             found {found:e}"
        );
        return Err(Diagnostic::file(path, message));
    }
    // The encoder takes a brightness below the least exponent for the largest one.
    let held = |texel: &Vec3| {
        if texel.max_element() < LEAST {
            Vec3::ZERO
        } else {
            texel.min(Vec3::splat(LARGEST))
        }
    };
    let texels = texels.iter().map(held);
    let texels: Vec<Rgb<f32>> = texels.map(|texel| Rgb(texel.to_array())).collect();
    let mut bytes = Vec::new();
    let written = HdrEncoder::new(&mut bytes).encode(&texels, width, height);
    written.map_err(|error| Diagnostic::file(path, format!("cannot be written: {error}")))?;
    write_atomically(path, &bytes)
}
