//! Portable float maps.

use std::path::Path;

use super::ImageFile;
use super::broken_texels::BrokenTexels;
use super::checked::checked;
use crate::Diagnostic;
use crate::glam::Vec3;

/// The image in the bytes of a PFM file: `PF` of three channels or `Pf` of one, rows from the
/// bottom, little-endian where the scale is negative. `path` names it in messages.
pub(super) fn parse_pfm(
    path: &Path,
    bytes: &[u8],
    broken: BrokenTexels,
) -> Result<ImageFile, Diagnostic> {
    let refuse = |message: String| Err(Diagnostic::file(path, message));
    let mut words = Words { bytes };
    let channels = match words.next() {
        Some("PF") => 3,
        Some("Pf") => 1,
        _ => return refuse("expected a PFM file: `PF` or `Pf` at its start".into()),
    };
    let mut side = || words.next()?.parse::<usize>().ok().filter(|&n| n > 0);
    let (Some(width), Some(height)) = (side(), side()) else {
        return refuse("expected width and height of a PFM file".into());
    };
    let scale = words.next().and_then(|word| word.parse::<f32>().ok());
    let Some(scale) = scale.filter(|scale| *scale != 0.0) else {
        return refuse("expected the scale of a PFM file, other than 0".into());
    };
    let data = words.bytes;
    let row = width.checked_mul(4 * channels);
    let expected = row.and_then(|row| row.checked_mul(height));
    if expected != Some(data.len()) {
        let found = data.len();
        return refuse(format!(
            "expected the texels of {width} x {height}, found {found} bytes"
        ));
    }
    let number = |bytes: &[u8]| {
        let bytes = bytes.try_into().unwrap_or_default();
        if scale < 0.0 {
            f32::from_le_bytes(bytes)
        } else {
            f32::from_be_bytes(bytes)
        }
    };
    let texel = |texel: &[u8]| match texel {
        [_, _, _, _] => Vec3::splat(number(texel)),
        _ => Vec3::new(
            number(&texel[..4]),
            number(&texel[4..8]),
            number(&texel[8..]),
        ),
    };
    let rows = data.chunks_exact(width * 4 * channels).rev();
    let texels = rows.flat_map(|row| row.chunks_exact(4 * channels).map(texel));
    checked(path, [width, height], texels.collect(), broken)
}

/// The words of a header, one blank after each.
struct Words<'a> {
    bytes: &'a [u8],
}

impl<'a> Words<'a> {
    /// The next word; the bytes after the one blank behind it are left.
    fn next(&mut self) -> Option<&'a str> {
        let end = self.bytes.iter().position(u8::is_ascii_whitespace)?;
        let (word, rest) = self.bytes.split_at(end);
        self.bytes = &rest[1..];
        core::str::from_utf8(word).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(header: &str, numbers: &[[u8; 4]]) -> Vec<u8> {
        [header.as_bytes(), numbers.as_flattened()].concat()
    }

    fn parse(bytes: &[u8]) -> Result<Vec<Vec3>, String> {
        let file = parse_pfm(Path::new("a.pfm"), bytes, BrokenTexels::Refuse)
            .map_err(|e| e.to_string())?;
        Ok(file.image.into_texels())
    }

    #[test]
    fn rows_run_upward_in_both_byte_orders() {
        let numbers = [1f32, 2.0, 3.0, 4.0];
        let texels = Ok([3.0, 4.0, 1.0, 2.0].map(Vec3::splat).to_vec());
        let little = file("Pf\n2 2\n-1.0\n", &numbers.map(f32::to_le_bytes));
        assert_eq!(parse(&little), texels, "little-endian");
        let big = file("Pf 2 2 1\n", &numbers.map(f32::to_be_bytes));
        assert_eq!(parse(&big), texels, "big-endian");
        let color = file("PF\n1 1\n-1\n", &[1f32, 2.0, 3.0].map(f32::to_le_bytes));
        assert_eq!(
            parse(&color),
            Ok(vec![Vec3::new(1.0, 2.0, 3.0)]),
            "three channels"
        );
    }

    #[test]
    fn broken_files_are_named() {
        for (bytes, message) in [
            (
                "P6\n",
                "a.pfm: expected a PFM file: `PF` or `Pf` at its start",
            ),
            (
                "PF\n0 2\n",
                "a.pfm: expected width and height of a PFM file",
            ),
            (
                "PF\n1 2\n0\n",
                "a.pfm: expected the scale of a PFM file, other than 0",
            ),
            (
                "PF\n1 2\n1\nabcd",
                "a.pfm: expected the texels of 1 x 2, found 4 bytes",
            ),
        ] {
            assert_eq!(
                parse(bytes.as_bytes()),
                Err(message.to_owned()),
                "{bytes:?}"
            );
        }
    }
}
