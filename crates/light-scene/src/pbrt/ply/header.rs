//! The header of a PLY file.

use super::body::Body;
use super::element::{Element, Format, Number, Property};
use crate::Diagnostic;
use crate::text::shown;

impl<'a> Body<'a> {
    /// The elements that follow, and how their numbers are written.
    pub(super) fn header(&mut self) -> Result<Vec<Element>, Diagnostic> {
        if self.header_line()? != "ply" {
            self.at = 0;
            return Err(self.error("expected `ply`"));
        }
        let mut elements: Vec<Element> = Vec::new();
        let mut format = None;
        loop {
            let start = self.at;
            let line = self.header_line()?;
            let words: Vec<&str> = line.split_whitespace().collect();
            let known = match words[..] {
                ["format", name, _] => {
                    format = Some(match name {
                        "ascii" => Format::Text,
                        "binary_little_endian" => Format::LittleEndian,
                        "binary_big_endian" => Format::BigEndian,
                        _ => Format::Text,
                    });
                    matches!(name, "ascii" | "binary_little_endian" | "binary_big_endian")
                }
                ["comment" | "obj_info", ..] | [] => true,
                ["element", name, count] => count.parse().is_ok_and(|count| {
                    let (name, properties) = (name.to_owned(), Vec::new());
                    elements.push(Element {
                        name,
                        count,
                        properties,
                    });
                    true
                }),
                ["property", ref rest @ ..] => match (elements.last_mut(), property(rest)) {
                    (Some(element), Some(property)) => {
                        element.properties.push(property);
                        true
                    }
                    _ => false,
                },
                ["end_header"] => break,
                _ => false,
            };
            if !known {
                self.at = start;
                let message = format!("expected a line of a PLY header, found `{}`", shown(line));
                return Err(self.error(message));
            }
        }
        self.format = format.ok_or_else(|| self.error("expected a `format` line"))?;
        Ok(elements)
    }

    fn header_line(&mut self) -> Result<&'a str, Diagnostic> {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|&b| b == b'\n');
        let end = end.ok_or_else(|| self.error("expected `end_header`"))?;
        let line = core::str::from_utf8(&rest[..end])
            .map_err(|_| self.error("expected a line of text"))?;
        self.at += end + 1;
        Ok(line.trim_end())
    }
}

fn property(words: &[&str]) -> Option<Property> {
    match words {
        ["list", count, number, name] => Some(Property::List(
            (*name).to_owned(),
            kind(count)?,
            kind(number)?,
        )),
        [number, name] => Some(Property::One((*name).to_owned(), kind(number)?)),
        _ => None,
    }
}

fn kind(name: &str) -> Option<Number> {
    Some(match name {
        "char" | "int8" => Number::I8,
        "uchar" | "uint8" => Number::U8,
        "short" | "int16" => Number::I16,
        "ushort" | "uint16" => Number::U16,
        "int" | "int32" => Number::I32,
        "uint" | "uint32" => Number::U32,
        "float" | "float32" => Number::F32,
        "double" | "float64" => Number::F64,
        _ => return None,
    })
}
