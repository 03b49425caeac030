use std::path::Path;

use exr::math::Vec2;
use exr::meta::attribute::Chromaticities;

use super::super::primaries;
use crate::Diagnostic;
use crate::diagnostic::Location;
use crate::glam::{DMat3, Vec3};
use crate::text::shown;

/// Of white light, as Radiance counts it.
const LUMENS_A_WATT: f32 = 179.0;

/// What the text before the texels says.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) layout: Layout,
    /// What the texels were multiplied by.
    pub(super) exposure: Vec3,
    pub(super) is_xyz: bool,
    /// From the colours of the texels; `None` where these are those of Rec. 709.
    pub(super) to_rec_709: Option<DMat3>,
    /// The byte of the first scanline.
    pub(super) data: usize,
}

/// Where the texels of a scanline are in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    width: usize,
    height: usize,
    /// Whether scanlines are columns.
    is_by_column: bool,
    /// Whether columns come from the right, and rows from the bottom.
    is_flipped: [bool; 2],
}

impl Header {
    /// The header at the start of a file.
    pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Self, Diagnostic> {
        let mut lines = Lines {
            path,
            bytes,
            at: 0,
            number: 0,
        };
        if !bytes.starts_with(b"#?") {
            let message = "expected a Radiance HDR file: its signature `#?RADIANCE` at its start";
            return Err(Diagnostic::file(path, message));
        }
        lines.next()?;
        let (mut exposure, mut is_xyz, mut chromaticities) = (Vec3::ONE, false, None);
        loop {
            let line = lines.next()?;
            if line.is_empty() {
                break;
            }
            let Some((key, value)) = line.split_once('=') else {
                continue;
            };
            match key.trim() {
                "FORMAT" => {
                    is_xyz = match value.trim() {
                        "32-bit_rle_rgbe" => false,
                        "32-bit_rle_xyze" => true,
                        other => {
                            let expected = "`FORMAT=32-bit_rle_rgbe` or `FORMAT=32-bit_rle_xyze`";
                            return Err(lines.expected(expected, other));
                        }
                    }
                }
                // Each program that changes a picture adds a line.
                "EXPOSURE" => {
                    exposure *= lines.numbers::<1>(value, "`EXPOSURE=` and a number above 0")?[0]
                }
                "COLORCORR" => {
                    let by = lines.numbers(value, "`COLORCORR=` and three numbers above 0")?;
                    exposure *= Vec3::from_array(by);
                }
                "PRIMARIES" => chromaticities = Some(lines.chromaticities(value)?),
                _ => {}
            }
        }
        let size = lines.next()?;
        let layout = Layout::parse(&size).ok_or_else(|| {
            lines.expected("the size of the picture, as `-Y HEIGHT +X WIDTH`", &size)
        })?;
        if !((1.0 / exposure).is_finite() && exposure.is_finite()) {
            let message = format!(
                "expected a product of exposures above 0, found {}",
                exposure.x
            );
            return Err(Diagnostic::file(path, message));
        }
        let to_rec_709 = if is_xyz {
            exposure *= LUMENS_A_WATT;
            Some(primaries::xyz_to_rec_709())
        } else {
            chromaticities.and_then(|file| primaries::to_rec_709(&file))
        };
        Ok(Self {
            layout,
            exposure,
            is_xyz,
            to_rec_709,
            data: lines.at,
        })
    }
}

impl Layout {
    /// The layout that the line before the texels names: the axis from scanline to scanline, then
    /// the axis along them.
    fn parse(line: &str) -> Option<Self> {
        let mut words = line.split_whitespace();
        let mut axis = || Some((words.next()?, words.next()?.parse::<usize>().ok()?));
        let ((across, lines), (along, length)) = (axis()?, axis()?);
        let (is_by_column, [x, y], [width, height]) = match (across, along) {
            ("-Y" | "+Y", "-X" | "+X") => (false, [along, across], [length, lines]),
            ("-X" | "+X", "-Y" | "+Y") => (true, [across, along], [lines, length]),
            _ => return None,
        };
        let is_whole = words.next().is_none() && width > 0 && height > 0;
        is_whole.then_some(Self {
            width,
            height,
            is_by_column,
            is_flipped: [x == "-X", y == "+Y"],
        })
    }

    pub(super) const fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The number of scanlines.
    pub(super) const fn lines(&self) -> usize {
        if self.is_by_column {
            self.width
        } else {
            self.height
        }
    }

    /// The texels of a scanline.
    pub(super) const fn line(&self) -> usize {
        if self.is_by_column {
            self.height
        } else {
            self.width
        }
    }

    /// The index of a texel, row by row from the top.
    pub(super) const fn index(&self, line: usize, place: usize) -> usize {
        let (mut x, mut y) = if self.is_by_column {
            (line, place)
        } else {
            (place, line)
        };
        if self.is_flipped[0] {
            x = self.width - 1 - x;
        }
        if self.is_flipped[1] {
            y = self.height - 1 - y;
        }
        y * self.width + x
    }
}

/// The lines of a header.
#[derive(Debug)]
struct Lines<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    /// The byte behind the last line, and its number.
    at: usize,
    number: usize,
}

impl Lines<'_> {
    /// The next line, without its end.
    fn next(&mut self) -> Result<String, Diagnostic> {
        let rest = &self.bytes[self.at..];
        let Some(length) = rest.iter().position(|&byte| byte == b'\n') else {
            let message = "expected a Radiance HDR file: the end of the file is missing";
            return Err(Diagnostic::file(self.path, message));
        };
        self.at += length + 1;
        self.number += 1;
        let line = String::from_utf8_lossy(&rest[..length]);
        Ok(line.trim_end_matches('\r').to_owned())
    }

    fn expected(&self, what: &str, found: &str) -> Diagnostic {
        let message = format!("expected {what}, found `{}`", shown(found));
        Diagnostic::at(self.path, Location::Line(self.number), message)
    }

    /// Numbers above 0.
    fn numbers<const N: usize>(&self, value: &str, what: &str) -> Result<[f32; N], Diagnostic> {
        let numbers = finite(value).filter(|numbers: &[f32; N]| numbers.iter().all(|&n| n > 0.0));
        numbers.ok_or_else(|| self.expected(what, value))
    }

    fn chromaticities(&self, value: &str) -> Result<Chromaticities, Diagnostic> {
        let numbers: Option<[f32; 8]> = finite(value);
        let [rx, ry, gx, gy, bx, by, wx, wy] = numbers.ok_or_else(|| {
            self.expected("`PRIMARIES=` and x, y of red, green, blue and white", value)
        })?;
        Ok(Chromaticities {
            red: Vec2(rx, ry),
            green: Vec2(gx, gy),
            blue: Vec2(bx, by),
            white: Vec2(wx, wy),
        })
    }
}

/// Just so many finite numbers.
fn finite<const N: usize>(value: &str) -> Option<[f32; N]> {
    let words = value.split_whitespace().map(|word| word.parse().ok());
    let numbers: Vec<f32> = words.collect::<Option<_>>()?;
    let numbers = <[f32; N]>::try_from(numbers).ok()?;
    numbers.iter().all(|n| n.is_finite()).then_some(numbers)
}
