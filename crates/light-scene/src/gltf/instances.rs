use super::mesh_uses::MeshUse;
use super::reader::Reader;
use crate::emissive_copies::EmissiveCopies;
use crate::glam::Affine3A;
use crate::{Diagnostic, Instance, Prototype};

impl Reader<'_> {
    /// Adds meshes of one node in world space, and meshes of several nodes as prototypes with
    /// instances.
    pub(super) fn add_instances(&mut self) -> Result<(), Diagnostic> {
        let mut copies = EmissiveCopies::default();
        for MeshUse { mesh, transforms } in core::mem::take(&mut self.uses).uses {
            if let [(node, transform)] = &transforms[..] {
                let mut meshes = self.primitives(&mesh, transform)?;
                // What people see and name in an editor.
                if !node.name().is_empty() {
                    meshes.iter_mut().for_each(|m| m.name = node.name().into());
                }
                self.scene.meshes.extend(meshes);
                continue;
            }
            let meshes = self.primitives(&mesh, &Affine3A::IDENTITY)?;
            let prototype = Prototype::new(mesh.name(), meshes);
            let boxes = prototype.boxes();
            let emissive = self.scene.emissive_count(&prototype);
            let prototype = self.scene.add_prototype(prototype);
            for (node, transform) in transforms {
                copies
                    .add(emissive, 1)
                    .map_err(|message| node.error(&message))?;
                let instance = Instance {
                    prototype,
                    transform,
                };
                if !instance.is_finite(&boxes) {
                    return Err(node.error("expected a transform that keeps vertices finite"));
                }
                self.scene.instances.push(instance);
            }
        }
        Ok(())
    }
}
