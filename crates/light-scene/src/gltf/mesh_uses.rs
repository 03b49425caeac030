use std::collections::HashMap;

use super::item::Item;
use super::reader::Reader;
use crate::glam::Affine3A;
use crate::shining_copies::ShiningCopies;
use crate::{Diagnostic, Placement, Prototype};

/// The meshes that nodes show, and where, in the order of their first use.
#[derive(Debug, Default)]
pub(super) struct MeshUses<'a> {
    by_mesh: HashMap<usize, usize>,
    uses: Vec<MeshUse<'a>>,
}

#[derive(Debug)]
struct MeshUse<'a> {
    mesh: Item<'a>,
    places: Vec<(Item<'a>, Affine3A)>,
}

impl<'a> MeshUses<'a> {
    /// `node` shows the mesh with this index.
    pub(super) fn add(&mut self, index: usize, mesh: Item<'a>, node: Item<'a>, place: Affine3A) {
        let number = *self.by_mesh.entry(index).or_insert(self.uses.len());
        if number == self.uses.len() {
            let places = Vec::new();
            self.uses.push(MeshUse { mesh, places });
        }
        self.uses[number].places.push((node, place));
    }
}

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
