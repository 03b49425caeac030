use alloc::string::ToString;
use alloc::vec::Vec;
use alloc::{format, vec};

use super::header::Header;
use super::lines::Lines;
use crate::axis::full_turn;
use crate::diagnostic::Diagnostic;
use crate::{PhotometricWeb, PhotometricWebError, WebType};

/// The angles and the intensities behind the `header`.
pub(super) fn read_web(
    file: &mut Lines<'_>,
    header: &Header,
) -> Result<PhotometricWeb, Diagnostic> {
    let &Header {
        symmetry, planes, ..
    } = header;
    let angles = file.list(planes, "a C angle")?;
    let used = used_planes(symmetry, planes).ok_or_else(|| {
        file.wrong(format!(
            "expected a number of C planes that suits the symmetry, found {planes}"
        ))
    })?;
    let after_horizontal = file.wrong(PhotometricWebError::Horizontal.to_string());
    let vertical = file.list(header.rows, "a gamma angle")?;
    let after_vertical = file.wrong(PhotometricWebError::Vertical.to_string());
    let mut by_plane = Vec::new();
    for &plane in &used {
        // Planes from C270 over C0 to C90 are those from 90 to 270, mirrored the other way
        // round.
        let angle = match symmetry {
            1 => 0.0,
            3 => full_turn(180.0 - angles[plane]),
            _ => angles[plane],
        };
        by_plane.push((angle, read_plane(file, header)?));
    }
    if symmetry == 3 {
        by_plane.reverse();
    }
    let horizontal: Vec<f32> = by_plane.iter().map(|plane| plane.0).collect();
    let candelas: Vec<f32> = by_plane.into_iter().flat_map(|plane| plane.1).collect();
    let web = PhotometricWeb::new(WebType::C, &vertical, &horizontal, &candelas);
    web.map_err(|error| match error {
        PhotometricWebError::Vertical => after_vertical,
        PhotometricWebError::Horizontal => after_horizontal,
        PhotometricWebError::Candelas => file.wrong(error.to_string()),
    })
}

/// The intensities of one plane, in candela.
fn read_plane(file: &mut Lines<'_>, header: &Header) -> Result<Vec<f32>, Diagnostic> {
    let factor = header.candelas_per_unit();
    let mut values = Vec::new();
    for _ in 0..header.rows {
        let value = factor * file.number("an intensity in cd/klm")?;
        if !(value >= 0.0 && value.is_finite()) {
            return Err(file.wrong(PhotometricWebError::Candelas.to_string()));
        }
        values.push(value);
    }
    Ok(values)
}

/// The planes whose intensities a file holds, by index of their angles; `None` where their number
/// does not fit the symmetry. Symmetry 3, to the plane of C90 and C270, holds those from C270 over
/// C0 to C90.
fn used_planes(symmetry: usize, planes: usize) -> Option<Vec<usize>> {
    Some(match symmetry {
        _ if planes == 0 => return None,
        0 => (0..planes).collect(),
        1 => vec![0],
        2 if planes % 2 == 0 => (0..=planes / 2).collect(),
        3 if planes % 4 == 0 => {
            let first = 3 * planes / 4;
            (first..=first + planes / 2)
                .map(|plane| plane % planes)
                .collect()
        }
        4 if planes % 4 == 0 => (0..=planes / 4).collect(),
        _ => return None,
    })
}
