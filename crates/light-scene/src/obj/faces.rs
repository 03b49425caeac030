use std::collections::HashMap;

use crate::glam::{Vec2, Vec3};
use crate::text::{Line, shown};
use crate::{Diagnostic, MaterialId, Mesh, polygon};

/// The attributes defined so far, and the meshes of the faces so far.
#[derive(Debug, Default)]
pub(super) struct Faces {
    pub(super) positions: Vec<Vec3>,
    pub(super) uvs: Vec<Vec2>,
    pub(super) normals: Vec<Vec3>,
    /// Names of groups by their numbers, the numbers by their names, and the one in force.
    names: Vec<String>,
    groups: HashMap<String, usize>,
    group: Option<usize>,
    pub(super) material: Option<MaterialId>,
    meshes: Vec<GrowingMesh>,
    /// Which mesh takes faces of a group, a material and a set of attributes.
    by_key: HashMap<(Option<usize>, MaterialId, Attributes), usize>,
}

/// What a corner has besides its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Attributes {
    uv: bool,
    normal: bool,
}

/// Indices from 0 into positions, texture coordinates and normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Corner {
    position: usize,
    uv: Option<usize>,
    normal: Option<usize>,
}

#[derive(Debug)]
struct GrowingMesh {
    mesh: Mesh,
    vertices: HashMap<Corner, u32>,
}

impl Faces {
    /// Adds the polygon of an `f` line as triangles.
    pub(super) fn push_polygon(
        &mut self,
        material: MaterialId,
        line: &mut Line<'_>,
    ) -> Result<(), Diagnostic> {
        let mut corners = Vec::with_capacity(4);
        while let Some(word) = line.word() {
            corners.push(self.corner(word, line)?);
        }
        if corners.len() < 3 {
            let found = corners.len();
            let message = format!("expected at least three corners, found {found}");
            return Err(line.diagnostic(message));
        }
        let attributes = corners[0].attributes();
        if corners.iter().any(|c| c.attributes() != attributes) {
            let message = "expected all corners alike: v, v/vt, v//vn or v/vt/vn";
            return Err(line.diagnostic(message));
        }
        let mesh = self.mesh(material, attributes);
        let Self {
            positions,
            uvs,
            normals,
            meshes,
            ..
        } = self;
        let GrowingMesh { mesh, vertices } = &mut meshes[mesh];
        let vertex = |corner: &Corner| {
            *vertices.entry(*corner).or_insert_with(|| {
                let index = mesh.next_vertex();
                mesh.positions.push(positions[corner.position]);
                if let (Some(all), Some(uv)) = (&mut mesh.uvs, corner.uv) {
                    all.push(uvs[uv]);
                }
                if let (Some(all), Some(normal)) = (&mut mesh.normals, corner.normal) {
                    all.push(normals[normal]);
                }
                index
            })
        };
        let around: Vec<u32> = corners.iter().map(vertex).collect();
        let places: Vec<Vec3> = corners.iter().map(|c| positions[c.position]).collect();
        let triangles = polygon::triangles(&places).map_err(|e| line.diagnostic(e.to_string()))?;
        let triangles = triangles.into_iter().map(|t| t.map(|i| around[i as usize]));
        mesh.indices.extend(triangles);
        Ok(())
    }

    /// What follows belongs to the group of this name.
    pub(super) fn begin_group(&mut self, name: String) {
        let number = *self.groups.entry(name).or_insert_with_key(|name| {
            self.names.push(name.clone());
            self.names.len() - 1
        });
        self.group = Some(number);
    }

    /// The meshes, in the order of their first faces.
    pub(super) fn into_meshes(self) -> Vec<Mesh> {
        let finished = self.meshes.into_iter().map(|GrowingMesh { mut mesh, .. }| {
            mesh.drop_empty_triangles();
            mesh
        });
        finished.filter(|mesh| !mesh.indices.is_empty()).collect()
    }

    fn mesh(&mut self, material: MaterialId, attributes: Attributes) -> usize {
        let key = (self.group, material, attributes);
        let Self {
            meshes,
            by_key,
            names,
            group,
            ..
        } = self;
        *by_key.entry(key).or_insert_with(|| {
            let name = group.map(|group| names[group].clone());
            let mut mesh = Mesh::new(name.unwrap_or_default(), material);
            mesh.uvs = attributes.uv.then(Vec::new);
            mesh.normals = attributes.normal.then(Vec::new);
            let vertices = HashMap::new();
            meshes.push(GrowingMesh { mesh, vertices });
            meshes.len() - 1
        })
    }

    fn corner(&self, word: &str, line: &Line<'_>) -> Result<Corner, Diagnostic> {
        let mut parts = word.split('/');
        let broken = || {
            let word = shown(word);
            line.diagnostic(format!(
                "expected v, v/vt, v//vn or v/vt/vn, found `{word}`"
            ))
        };
        let mut index = |count, what| match parts.next() {
            None | Some("") => Ok(None),
            Some(number) => {
                let number = number.parse::<i64>().map_err(|_| broken())?;
                resolve(number, count).map(Some).ok_or_else(|| {
                    line.diagnostic(format!("{what} {number} of {count} does not exist"))
                })
            }
        };
        let position = index(self.positions.len(), "vertex")?;
        let uv = index(self.uvs.len(), "texture coordinate")?;
        let normal = index(self.normals.len(), "normal")?;
        if parts.next().is_some() {
            return Err(broken());
        }
        let position = position.ok_or_else(broken)?;
        Ok(Corner {
            position,
            uv,
            normal,
        })
    }
}

impl Corner {
    fn attributes(&self) -> Attributes {
        Attributes {
            uv: self.uv.is_some(),
            normal: self.normal.is_some(),
        }
    }
}

/// The index from 0 that `number` means: 1 is the first of `count`, -1 the last.
fn resolve(number: i64, count: usize) -> Option<usize> {
    let index = if number > 0 {
        usize::try_from(number).ok()?.checked_sub(1)?
    } else {
        count.checked_sub(usize::try_from(number.checked_neg()?).ok()?)?
    };
    (index < count).then_some(index)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_count_from_one_or_backwards() {
        assert_eq!(resolve(1, 3), Some(0), "first");
        assert_eq!(resolve(3, 3), Some(2), "last");
        assert_eq!(resolve(-1, 3), Some(2), "last");
        assert_eq!(resolve(-3, 3), Some(0), "first");
        for bad in [0, 4, -4, i64::MIN, i64::MAX] {
            assert_eq!(resolve(bad, 3), None, "{bad} of 3");
        }
    }
}
