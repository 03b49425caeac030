use alloc::collections::BTreeSet;
use std::collections::HashMap;

use super::corner::{Attributes, Corner};
use crate::glam::{Vec2, Vec3};
use crate::{MaterialId, Mesh, polygon};

/// The parts of a file that become one mesh each: faces of a group, a material and a set of
/// attributes. `tobj` reads each as an object whose name is the number of its section.
#[derive(Debug, Default)]
pub(super) struct Sections {
    /// Names of groups by their numbers, the numbers by their names, and the one in force.
    names: Vec<String>,
    groups: HashMap<String, usize>,
    group: Option<usize>,
    sections: Vec<Section>,
    by_key: HashMap<Section, usize>,
    current: Option<usize>,
}

/// What the faces of a section have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Section {
    group: Option<usize>,
    material: MaterialId,
    attributes: Attributes,
}

/// A face that takes too long, and the number of its corners.
#[derive(Debug)]
pub(super) struct BadFace {
    pub(super) corners: usize,
    pub(super) message: String,
}

impl Sections {
    /// What follows belongs to the group of this name.
    pub(super) fn begin_group(&mut self, name: String) {
        let number = *self.groups.entry(name).or_insert_with_key(|name| {
            self.names.push(name.clone());
            self.names.len() - 1
        });
        self.group = Some(number);
    }

    /// The number of the section of a face, if it is not that of the face before.
    pub(super) fn change(&mut self, material: MaterialId, corner: Corner) -> Option<usize> {
        let section = Section {
            group: self.group,
            material,
            attributes: corner.attributes(),
        };
        if self.current.map(|current| self.sections[current]) == Some(section) {
            return None;
        }
        let number = *self.by_key.entry(section).or_insert_with(|| {
            self.sections.push(section);
            self.sections.len() - 1
        });
        self.current = Some(number);
        Some(number)
    }

    /// The meshes of the objects that `tobj` made, in the order of their first faces.
    ///
    /// # Errors
    /// When a face takes too long.
    pub(super) fn meshes(&self, objects: &[tobj::Model]) -> Result<Vec<Mesh>, BadFace> {
        let begun = self.sections.iter().map(|section| {
            let name = section.group.map(|group| self.names[group].clone());
            let mut mesh = Mesh::new(name.unwrap_or_default(), section.material);
            mesh.uvs = section.attributes.uv.then(Vec::new);
            mesh.normals = section.attributes.normal.then(Vec::new);
            mesh
        });
        let mut meshes: Vec<Mesh> = begun.collect();
        let mut returned_to = BTreeSet::new();
        for tobj::Model { mesh, name } in objects {
            let number = name
                .parse()
                .ok()
                .filter(|&number: &usize| number < meshes.len());
            if let Some(number) = number {
                if !meshes[number].indices.is_empty() {
                    returned_to.insert(number);
                }
                append(&mut meshes[number], mesh)?;
            }
        }
        for number in returned_to {
            share_vertices(&mut meshes[number]);
        }
        meshes.iter_mut().for_each(Mesh::drop_empty_triangles);
        meshes.retain(|mesh| !mesh.indices.is_empty());
        Ok(meshes)
    }
}

/// Makes one of equal vertices: `tobj` shares those of an object alone, and a file may return to a
/// section.
fn share_vertices(mesh: &mut Mesh) {
    let old = core::mem::replace(mesh, Mesh::new("", mesh.material));
    let mut known = HashMap::with_capacity(old.positions.len());
    let bits = |vector: Vec3| vector.to_array().map(f32::to_bits);
    let number = (0..old.positions.len()).map(|vertex| {
        let uv = old.uvs.as_ref().map(|all| all[vertex]);
        let normal = old.normals.as_ref().map(|all| all[vertex]);
        let uv_bits = uv.map(|uv| uv.to_array().map(f32::to_bits));
        let key = (bits(old.positions[vertex]), uv_bits, normal.map(bits));
        *known.entry(key).or_insert_with(|| {
            let next = mesh.next_vertex();
            mesh.positions.push(old.positions[vertex]);
            if let Some(uv) = uv {
                mesh.uvs.get_or_insert_with(Vec::new).push(uv);
            }
            if let Some(normal) = normal {
                mesh.normals.get_or_insert_with(Vec::new).push(normal);
            }
            next
        })
    });
    let numbers: Vec<u32> = number.collect();
    let triangles = old.indices.into_iter();
    mesh.indices = triangles.map(|t| t.map(|i| numbers[i as usize])).collect();
    mesh.name = old.name;
}

/// Adds the faces of an object to a mesh.
fn append(to: &mut Mesh, object: &tobj::Mesh) -> Result<(), BadFace> {
    let first = to.next_vertex();
    let places = object.positions.chunks_exact(3).map(Vec3::from_slice);
    to.positions.extend(places);
    if let Some(uvs) = &mut to.uvs {
        uvs.extend(object.texcoords.chunks_exact(2).map(Vec2::from_slice));
    }
    if let Some(normals) = &mut to.normals {
        normals.extend(object.normals.chunks_exact(3).map(Vec3::from_slice));
    }
    if object.face_arities.is_empty() {
        let triangles = object.indices.chunks_exact(3);
        to.indices
            .extend(triangles.map(|t| [t[0], t[1], t[2]].map(|i| first + i)));
        return Ok(());
    }
    let mut rest = &object.indices[..];
    let mut corners = Vec::new();
    for &count in &object.face_arities {
        let (face, after) = rest.split_at(count as usize);
        rest = after;
        corners.clear();
        corners.extend(face.iter().map(|&i| to.positions[(first + i) as usize]));
        let triangles = polygon::triangles(&corners).map_err(|error| BadFace {
            corners: face.len(),
            message: error.to_string(),
        })?;
        let triangles = triangles.into_iter();
        to.indices
            .extend(triangles.map(|t| t.map(|i| first + face[i as usize])));
    }
    Ok(())
}
