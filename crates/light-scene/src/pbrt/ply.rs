//! PLY meshes: text, and binary of both byte orders.

use core::str::FromStr;
use std::path::Path;

use crate::glam::{Vec2, Vec3};
use crate::text::{read_bytes, shown};
use crate::{Diagnostic, MaterialId, Mesh, Place};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Text,
    LittleEndian,
    BigEndian,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

#[derive(Clone, Debug)]
enum Property {
    One(String, Number),
    List(String, Number, Number),
}

#[derive(Clone, Debug)]
struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

/// Reads a PLY file's vertices and faces.
pub(super) fn read_ply(path: &Path) -> Result<Mesh, Diagnostic> {
    parse_ply(path, &read_bytes(path)?)
}

/// As [`read_ply`], from the bytes of the file; `path` names it in messages.
pub(crate) fn parse_ply(path: &Path, bytes: &[u8]) -> Result<Mesh, Diagnostic> {
    if bytes.starts_with(&[0x1f, 0x8b]) {
        return Err(Diagnostic::file(
            path,
            "expected a PLY file that is not compressed, found gzip",
        ));
    }
    let mut body = Body {
        path,
        bytes,
        at: 0,
        format: Format::Text,
    };
    let elements = body.header()?;
    let mut mesh = Mesh::new("", MaterialId(0));
    // An element without properties takes no data, however many it says there are.
    for element in elements.iter().filter(|e| !e.properties.is_empty()) {
        for _ in 0..element.count {
            match element.name.as_str() {
                "vertex" => body.vertex(element, &mut mesh)?,
                "face" => body.face(element, &mut mesh)?,
                _ => element
                    .properties
                    .iter()
                    .try_for_each(|p| body.property(p).map(drop))?,
            }
        }
    }
    Ok(mesh)
}

struct Body<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    at: usize,
    format: Format,
}

impl<'a> Body<'a> {
    fn error(&self, message: impl Into<String>) -> Diagnostic {
        let place = match self.format {
            Format::Text => Place::Line(
                1 + self.bytes[..self.at]
                    .iter()
                    .filter(|&&b| b == b'\n')
                    .count(),
            ),
            _ => Place::Byte(self.at),
        };
        Diagnostic::at(self.path, place, message)
    }

    fn header(&mut self) -> Result<Vec<Element>, Diagnostic> {
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

    fn vertex(&mut self, element: &Element, mesh: &mut Mesh) -> Result<(), Diagnostic> {
        let (mut position, mut normal, mut uv) = (Vec3::ZERO, None, None);
        for property in &element.properties {
            let value = self.property(property)?;
            let Property::One(name, _) = property else {
                continue;
            };
            let value = single(value.first().copied().unwrap_or_default());
            if !value.is_finite() {
                return Err(self.error(format!("expected a finite `{}`", shown(name))));
            }
            match name.as_str() {
                "x" => position.x = value,
                "y" => position.y = value,
                "z" => position.z = value,
                "nx" => normal.get_or_insert(Vec3::ZERO).x = value,
                "ny" => normal.get_or_insert(Vec3::ZERO).y = value,
                "nz" => normal.get_or_insert(Vec3::ZERO).z = value,
                "u" | "s" | "texture_u" | "texture_s" => uv.get_or_insert(Vec2::ZERO).x = value,
                "v" | "t" | "texture_v" | "texture_t" => uv.get_or_insert(Vec2::ZERO).y = value,
                _ => {}
            }
        }
        mesh.positions.push(position);
        if let Some(normal) = normal {
            mesh.normals.get_or_insert_with(Vec::new).push(normal);
        }
        if let Some(uv) = uv {
            mesh.uvs.get_or_insert_with(Vec::new).push(uv);
        }
        Ok(())
    }

    fn face(&mut self, element: &Element, mesh: &mut Mesh) -> Result<(), Diagnostic> {
        for property in &element.properties {
            let values = self.property(property)?;
            let Property::List(name, ..) = property else {
                continue;
            };
            if !matches!(name.as_str(), "vertex_indices" | "vertex_index") {
                continue;
            }
            let mut corners = Vec::with_capacity(values.len());
            for value in values {
                let count = mesh.positions.len();
                let index = index(value).filter(|&i| (i as usize) < count);
                let message = || format!("vertex {value} of {count} does not exist");
                corners.push(index.ok_or_else(|| self.error(message()))?);
            }
            if corners.len() < 3 {
                return Err(self.error("expected at least three corners of a face"));
            }
            let fan = corners[1..]
                .windows(2)
                .map(|edge| [corners[0], edge[0], edge[1]]);
            mesh.indices.extend(fan);
        }
        Ok(())
    }

    /// The values of a property: one, or those of the list.
    fn property(&mut self, property: &Property) -> Result<Vec<f64>, Diagnostic> {
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
        let message = || format!("expected a number, found `{}`", shown(word));
        let number = parsed.map_err(|_| self.error(message()))?;
        self.at += end - start;
        Ok(number)
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

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be whole and in range"
)]
fn index(value: f64) -> Option<u32> {
    (value >= 0.0 && value <= f64::from(u32::MAX) && value.fract() == 0.0).then_some(value as u32)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "checked to be finite by the caller"
)]
const fn single(value: f64) -> f32 {
    value as f32
}
