use super::mesh_uses::MeshUse;
use super::reader::Reader;
use crate::glam::Affine3A;
use crate::shining_copies::ShiningCopies;
use crate::{Diagnostic, Placement, Prototype};

impl Reader<'_> {
    /// Meshes that one node shows stand where they are; those of several nodes are prototypes.
    pub(super) fn place_meshes(&mut self) -> Result<(), Diagnostic> {
        let mut copies = ShiningCopies::default();
        for MeshUse { mesh, places } in core::mem::take(&mut self.uses).uses {
            if let [(_, place)] = &places[..] {
                let placed = self.primitives(&mesh, place)?;
                self.scene.meshes.extend(placed);
                continue;
            }
            let meshes = self.primitives(&mesh, &Affine3A::IDENTITY)?;
            let prototype = Prototype::new(mesh.name(), meshes);
            let boxes = prototype.boxes();
            let shining = self.scene.shining_count(&prototype);
            let prototype = self.scene.add_prototype(prototype);
            for (node, place) in places {
                copies
                    .add(shining, 1)
                    .map_err(|message| node.error(&message))?;
                let placement = Placement { prototype, place };
                if !placement.is_finite(&boxes) {
                    return Err(node.error("expected a transform that keeps vertices finite"));
                }
                self.scene.placements.push(placement);
            }
        }
        Ok(())
    }
}
