//! PLY meshes: text, and binary of both byte orders, compressed by gzip or not.

mod body;
mod element;
mod header;

use alloc::borrow::Cow;
use std::path::Path;

use self::body::{Body, index};
use self::element::{Element, Format, Property};
use super::included::Included;
use crate::glam::{Vec2, Vec3};
use crate::gunzip::gunzipped;
use crate::text::{shown, without_mark};
use crate::{Diagnostic, Files, MaterialId, Mesh, polygon};

/// Reads a PLY file's vertices and faces, and counts its bytes if they are compressed.
pub(super) fn read_ply(
    path: &Path,
    files: Files<'_>,
    included: &mut Included,
) -> Result<Mesh, Diagnostic> {
    let bytes = files.read(path)?;
    let plain = gunzipped(path, &bytes)?;
    if let Cow::Owned(unpacked) = &plain {
        let counted = included.add_unpacked(unpacked.len());
        counted.map_err(|message| Diagnostic::file(path, message))?;
    }
    parse_unpacked(path, &plain)
}

/// The vertices and faces in the bytes of a PLY file, compressed by gzip or not; `path` names it in
/// messages. Normals that are not finite become 0.
///
/// # Errors
/// When the file is broken, or a face names a vertex that is not there: with line or byte, and what
/// was expected.
pub fn parse_ply(path: &Path, bytes: &[u8]) -> Result<Mesh, Diagnostic> {
    let mut mesh = parse_unpacked(path, &gunzipped(path, bytes)?)?;
    mesh.drop_broken_normals();
    Ok(mesh)
}

fn parse_unpacked(path: &Path, bytes: &[u8]) -> Result<Mesh, Diagnostic> {
    let mut body = Body {
        path,
        bytes,
        at: bytes.len() - without_mark(bytes).len(),
        format: Format::Text,
    };
    let elements = body.header()?;
    for name in ["x", "y", "z"] {
        let has = |p: &Property| matches!(p, Property::One(own, _) if own == name);
        let vertices = elements.iter().filter(|element| element.name == "vertex");
        if !vertices
            .clone()
            .all(|element| element.properties.iter().any(has))
        {
            return Err(body.error(format!("expected a property `{name}` of vertices")));
        }
    }
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
    if mesh.indices.is_empty() {
        return Err(body.error("expected at least one face"));
    }
    Ok(mesh)
}

impl Body<'_> {
    fn vertex(&mut self, element: &Element, mesh: &mut Mesh) -> Result<(), Diagnostic> {
        let (mut position, mut normal, mut uv) = (Vec3::ZERO, None, None);
        for property in &element.properties {
            let value = self.property(property)?;
            let Property::One(name, _) = property else {
                continue;
            };
            let value = single(value.first().copied().unwrap_or_default());
            let may_be_broken = matches!(name.as_str(), "nx" | "ny" | "nz");
            if !value.is_finite() && !may_be_broken {
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
        let mut has_corners = false;
        for property in &element.properties {
            let values = self.property(property)?;
            let Property::List(name, ..) = property else {
                continue;
            };
            if !matches!(name.as_str(), "vertex_indices" | "vertex_index") {
                continue;
            }
            has_corners = true;
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
            let place = |&corner: &u32| mesh.positions[corner as usize];
            let places: Vec<Vec3> = corners.iter().map(place).collect();
            let triangles = polygon::triangles(&places).map_err(|e| self.error(e.to_string()))?;
            let triangles = triangles
                .into_iter()
                .map(|t| t.map(|i| corners[i as usize]));
            mesh.indices.extend(triangles);
        }
        if !has_corners {
            return Err(self.error("expected a list `vertex_indices` of faces"));
        }
        Ok(())
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the caller looks whether it is finite"
)]
const fn single(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests;
