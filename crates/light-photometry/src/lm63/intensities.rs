use alloc::string::ToString;
use alloc::vec::Vec;

use super::header::Header;
use crate::diagnostic::Diagnostic;
use crate::numbers::Numbers;
use crate::{PhotometricWeb, PhotometricWebError};

/// The angles and intensities behind the `header`.
pub(super) fn read_web(
    numbers: &mut Numbers<'_>,
    header: &Header,
) -> Result<PhotometricWeb, Diagnostic> {
    let vertical = numbers.list(header.vertical, "a vertical angle")?;
    let after_vertical = numbers.wrong(PhotometricWebError::Vertical.to_string());
    let horizontal = numbers.list(header.horizontal, "a horizontal angle")?;
    let after_horizontal = numbers.wrong(PhotometricWebError::Horizontal.to_string());
    let mut candelas = Vec::new();
    for _ in 0..vertical.len() * horizontal.len() {
        let value = header.factor * numbers.number("an intensity in candela")?;
        if !(value >= 0.0 && value.is_finite()) {
            return Err(numbers.wrong(PhotometricWebError::Candelas.to_string()));
        }
        candelas.push(value);
    }
    let web = PhotometricWeb::new(header.web_type, &vertical, &horizontal, &candelas);
    web.map_err(|error| match error {
        PhotometricWebError::Vertical => after_vertical,
        PhotometricWebError::Horizontal => after_horizontal,
        PhotometricWebError::Candelas => numbers.wrong(error.to_string()),
    })
}
