//! Radiance pictures (`.hdr`): texels of a common exponent.

mod header;
mod scanline;
mod write;

use std::path::Path;

use super::ImageFile;
use super::broken_texels::BrokenTexels;
use super::checked::checked;
use super::primaries;
use crate::Diagnostic;
use crate::diagnostic::Location;
use crate::glam::Vec3;

use header::{Header, Layout};
use scanline::Scanlines;
pub(crate) use write::write_hdr;

/// The most texels a byte of a file: a run of 127 takes two bytes for each of four components. What
/// has fewer texels than a small picture may be one run of the old kind.
const DENSEST: usize = 16;
const SMALL: usize = 1 << 22;

/// An exposure that is nearer to 1 is not worth a word: Radiance itself does not write it.
const EXPOSED: f32 = 0.01;

/// The image in the bytes of a Radiance picture, of RGBE or XYZE texels; `path` names it in
/// messages.
///
/// The texels are radiance: divided by the exposure and the colour correction that the header says
/// they were multiplied by, with a warning where that is not 1, as some programs leave it out. XYZ
/// is in lumens, of which Radiance has 179 a watt. Colours of other primaries become those of
/// Rec. 709.
///
/// # Source
/// `[Radiance]`, `color.c`, `ra_xyze.c` and the page on file formats; but a texel is the lower end of
/// what its mantissa stands for, as most programs read it, not the middle.
pub(super) fn parse_hdr(
    path: &Path,
    bytes: &[u8],
    broken: BrokenTexels,
) -> Result<ImageFile, Diagnostic> {
    let Header {
        layout,
        exposure,
        is_xyz,
        to_rec_709,
        data,
    } = Header::parse(path, bytes)?;
    let [width, height] = layout.size();
    let count = width.checked_mul(height);
    let most = bytes.len().saturating_mul(DENSEST).max(SMALL);
    let Some(count) = count.filter(|&count| count <= most) else {
        let found = bytes.len();
        let message =
            format!("expected the texels of {width} x {height}, found {found} bytes in all");
        return Err(Diagnostic::file(path, message));
    };
    let mut texels = read_texels(path, bytes, data, &layout, count)?;
    for texel in &mut texels {
        *texel /= exposure;
    }
    if let Some(matrix) = to_rec_709 {
        primaries::convert(&mut texels, &matrix);
    }
    let mut file = checked(path, [width, height], texels, broken)?;
    if exposure.abs_diff_eq(Vec3::ONE, EXPOSED) {
        return Ok(file);
    }
    let by = if exposure == Vec3::splat(exposure.x) {
        exposure.x.to_string()
    } else {
        exposure.to_string()
    };
    let mut message = format!("texels were divided by {by}, the exposure of the header");
    if is_xyz {
        message += " times 179 lm/W";
    }
    message += ": some programs leave this out";
    if let Some(warning) = file.warning {
        message = format!("{message}; {}", warning.message);
    }
    file.warning = Some(Diagnostic::file(path, message));
    Ok(file)
}

/// The texels row by row from the top, as the file has them.
fn read_texels(
    path: &Path,
    bytes: &[u8],
    data: usize,
    layout: &Layout,
    count: usize,
) -> Result<Vec<Vec3>, Diagnostic> {
    let mut lines = Scanlines::new(&bytes[data..], layout.line());
    let mut texels = vec![Vec3::ZERO; count];
    let scales = scales();
    for number in 0..layout.lines() {
        let line = lines.next().map_err(|fault| {
            let location = Location::Byte(data + fault.byte);
            let message = format!("scanline {number}: expected {}", fault.expected);
            Diagnostic::at(path, location, message)
        })?;
        for (place, &[r, g, b, exponent]) in line.iter().enumerate() {
            let mantissas = Vec3::new(r.into(), g.into(), b.into());
            texels[layout.index(number, place)] = mantissas * scales[usize::from(exponent)];
        }
    }
    Ok(texels)
}

/// What a step of a mantissa is worth, for each exponent; with exponent 0 a texel is black.
fn scales() -> [f32; 256] {
    let mut scales = [0.0; 256];
    // 2^-135 is exact, though subnormal.
    let mut scale = f32::MIN_POSITIVE * 2f32.powi(-9);
    for of_exponent in &mut scales[1..] {
        *of_exponent = scale;
        scale *= 2.0;
    }
    scales
}

#[cfg(test)]
mod tests;
