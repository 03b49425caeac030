use std::collections::{HashMap, HashSet};

use super::file_loc::FileLoc;
use super::state::Reader;
use crate::glam::Vec3;
use crate::text::shown;
use crate::{Diagnostic, Material, MaterialId, Surface};

/// A message lists at most so many names.
const MOST_NAMES: usize = 8;

impl Reader {
    /// The material with this name, which may still be empty.
    pub(super) fn named_material(&mut self, at: FileLoc<'_>, name: &str) -> MaterialId {
        let Self {
            materials, scene, ..
        } = self;
        if let Some(&id) = materials.by_name.get(name) {
            return id;
        }
        let (id, _) = materials.awaited.entry(name.to_owned()).or_insert_with(|| {
            let message = format!("expected a named material, found \"{}\"", shown(name));
            let empty = Material::diffuse(name, Vec3::ZERO);
            (scene.add_material(empty), at.diagnostic(message))
        });
        materials.awaited_ids.insert(*id);
        *id
    }

    /// Gives a name to a material that has just been described.
    pub(super) fn name_material(
        &mut self,
        name: String,
        described: MaterialId,
    ) -> Result<(), Diagnostic> {
        let id = match self.materials.awaited.remove(&name) {
            Some((id, first_use)) => {
                self.materials.awaited_ids.remove(&id);
                let uses_later = match self.scene.material(described).surface {
                    Surface::Mix { materials, .. } => materials.into_iter().any(|part| part >= id),
                    _ => false,
                };
                if uses_later {
                    let what = if self.is_made_of(described, id) {
                        "not to be made of itself"
                    } else {
                        "to be described before its use"
                    };
                    let message = format!("expected the mixture \"{}\" {what}", shown(&name));
                    return Err(Diagnostic {
                        message,
                        ..first_use
                    });
                }
                self.materials.twins.push((id, described));
                id
            }
            None => {
                let material = &mut self.scene.materials[described.0 as usize];
                material.name.clone_from(&name);
                described
            }
        };
        self.materials.by_name.insert(name, id);
        Ok(())
    }

    /// Whether `part` is in a mixture, or in one that is in it.
    fn is_made_of(&self, mixture: MaterialId, part: MaterialId) -> bool {
        let described: HashMap<_, _> = self.materials.twins.iter().copied().collect();
        let mut seen = HashSet::new();
        let mut open = vec![mixture];
        while let Some(id) = open.pop() {
            if id == part {
                return true;
            }
            if seen.insert(id) {
                open.extend(described.get(&id));
                if let Surface::Mix { materials, .. } = self.scene.material(id).surface {
                    open.extend(materials);
                }
            }
        }
        false
    }

    /// A material with the surface of another one, changed otherwise.
    pub(super) fn twin(
        &mut self,
        of: MaterialId,
        change: impl FnOnce(&mut Material),
    ) -> MaterialId {
        let mut material = self.scene.material(of).clone();
        change(&mut material);
        let twin = self.scene.add_material(material);
        self.materials.twins.push((twin, of));
        twin
    }

    /// The names of materials that there are, for a message about one that there is not.
    fn known_names(&self) -> String {
        let mut names: Vec<&str> = self.materials.by_name.keys().map(String::as_str).collect();
        names.sort_unstable();
        let more = if names.len() > MOST_NAMES { ", .." } else { "" };
        names.truncate(MOST_NAMES);
        let names: Vec<String> = names.iter().map(|n| format!("\"{}\"", shown(n))).collect();
        if names.is_empty() {
            return String::new();
        }
        format!("; the file names {}{more}", names.join(", "))
    }

    /// Sets the surfaces of materials that were used before their definition, after the last
    /// directive.
    pub(super) fn finish_materials(&mut self) -> Result<(), Diagnostic> {
        let awaited = core::mem::take(&mut self.materials.awaited).into_values();
        if let Some((_, mut unknown)) = awaited.min_by_key(|(id, _)| *id) {
            unknown.message += &self.known_names();
            return Err(unknown);
        }
        let twins = core::mem::take(&mut self.materials.twins);
        let surface_of: HashMap<MaterialId, MaterialId> = twins.iter().copied().collect();
        for (twin, _) in twins {
            let mut described = twin;
            while let Some(&of) = surface_of.get(&described) {
                described = of;
            }
            let surface = self.scene.material(described).surface.clone();
            self.scene.materials[twin.0 as usize].surface = surface;
        }
        Ok(())
    }
}
