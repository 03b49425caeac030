//! The numbers of a PLY file.

use core::str::FromStr;
use std::path::Path;

use super::element::{Format, Number, Property};
use crate::text::shown;
use crate::{Diagnostic, Location};

/// A PLY file and how far it has been read.
pub(super) struct Body<'a> {
    pub(super) path: &'a Path,
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
    pub(super) format: Format,
}

impl Body<'_> {
    pub(super) fn error(&self, message: impl Into<String>) -> Diagnostic {
        let location = match self.format {
            Format::Text => Location::Line(
                1 + self.bytes[..self.at]
                    .iter()
                    .filter(|&&b| b == b'\n')
                    .count(),
            ),
            _ => Location::Byte(self.at),
        };
        Diagnostic::at(self.path, location, message)
    }

    /// The values of a property: one, or those of the list.
    pub(super) fn property(&mut self, property: &Property) -> Result<Vec<f64>, Diagnostic> {
        match property {
            Property::One(_, number) => Ok(vec![self.number(*number)?]),
            Property::List(_, count, number) => {
                let count = index(self.number(*count)?);
                let count = count.ok_or_else(|| self.error("expected the length of a list"))?;
                (0..count).map(|_| self.number(*number)).collect()
            }
        }
    }

    fn number(&mut self, number: Number) -> Result<f64, Diagnostic> {
        if self.format == Format::Text {
            return self.text_number();
        }
        let size = match number {
            Number::I8 | Number::U8 => 1,
            Number::I16 | Number::U16 => 2,
            Number::I32 | Number::U32 | Number::F32 => 4,
            Number::F64 => 8,
        };
        let taken = self.bytes.get(self.at..self.at + size);
        let taken =
            taken.ok_or_else(|| self.error("expected more data, found the end of the file"))?;
        // The bytes from the least significant on.
        let mut raw = [0u8; 8];
        raw[..size].copy_from_slice(taken);
        if self.format == Format::BigEndian {
            raw[..size].reverse();
        }
        self.at += size;
        let [a, b, c, d, ..] = raw;
        Ok(match number {
            Number::I8 => f64::from(i8::from_le_bytes([a])),
            Number::U8 => f64::from(a),
            Number::I16 => f64::from(i16::from_le_bytes([a, b])),
            Number::U16 => f64::from(u16::from_le_bytes([a, b])),
            Number::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            Number::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
            Number::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
            Number::F64 => f64::from_le_bytes(raw),
        })
    }

    fn text_number(&mut self) -> Result<f64, Diagnostic> {
        let is_blank = |b: &u8| b.is_ascii_whitespace();
        let rest = &self.bytes[self.at..];
        let start = rest.iter().position(|b| !is_blank(b)).unwrap_or(rest.len());
        let end = rest[start..]
            .iter()
            .position(is_blank)
            .map_or(rest.len(), |end| start + end);
        self.at += start;
        let word = core::str::from_utf8(&rest[start..end]).unwrap_or_default();
        let parsed = f64::from_str(word);
        let found = || match word {
            "" if start == rest.len() => "the end of the file".to_owned(),
            word => format!("`{}`", shown(word)),
        };
        let message = || format!("expected a number, found {}", found());
        let number = parsed.map_err(|_| self.error(message()))?;
        self.at += end - start;
        Ok(number)
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be whole and in range"
)]
pub(super) fn index(value: f64) -> Option<u32> {
    (value >= 0.0 && value <= f64::from(u32::MAX) && value.fract() == 0.0).then_some(value as u32)
}
