use std::collections::HashMap;

use super::item::Item;
use crate::glam::Affine3A;

/// The meshes that nodes show, and where, in the order of their first use.
#[derive(Debug, Default)]
pub(super) struct MeshUses<'a> {
    by_mesh: HashMap<usize, usize>,
    pub(super) uses: Vec<MeshUse<'a>>,
}

#[derive(Debug)]
pub(super) struct MeshUse<'a> {
    pub(super) mesh: Item<'a>,
    pub(super) transforms: Vec<(Item<'a>, Affine3A)>,
}

impl<'a> MeshUses<'a> {
    /// `node` shows the mesh with this index.
    pub(super) fn add(
        &mut self,
        index: usize,
        mesh: Item<'a>,
        node: Item<'a>,
        transform: Affine3A,
    ) {
        let number = *self.by_mesh.entry(index).or_insert(self.uses.len());
        if number == self.uses.len() {
            let transforms = Vec::new();
            self.uses.push(MeshUse { mesh, transforms });
        }
        self.uses[number].transforms.push((node, transform));
    }
}
