use alloc::vec::Vec;

use crate::bytes::header::{HEADER, Header, TreeBytesError};
use crate::bytes::stored::StoredLightBvh;
use crate::light_bvh::LightBvh;

impl LightBvh {
    /// The tree as bytes, with the groups of its lights, for [`StoredLightBvh::from_bytes`] and
    /// [`from_bytes`](Self::from_bytes).
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let counts = [
            self.nodes.len(),
            self.order.len(),
            self.slots.len(),
            self.groups.len(),
        ];
        let header = Header::new(counts, self.power);
        let mut bytes = Vec::with_capacity(HEADER + self.bytes());
        bytes.extend_from_slice(bytemuck::bytes_of(&header));
        bytes.extend_from_slice(bytemuck::cast_slice(&self.nodes));
        bytes.extend_from_slice(bytemuck::cast_slice(&self.order));
        bytes.extend_from_slice(bytemuck::cast_slice(&self.slots));
        bytes.extend_from_slice(bytemuck::cast_slice(&self.groups));
        bytes
    }

    /// A copy of the tree in `bytes`, wherever they begin, that can be refitted.
    ///
    /// # Errors
    /// The first thing that is wrong: see [`TreeBytesError`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, TreeBytesError> {
        let (header, [nodes, order, slots, groups]) = Header::split(bytes)?;
        let tree = Self {
            nodes: bytemuck::pod_collect_to_vec(nodes),
            order: bytemuck::pod_collect_to_vec(order),
            slots: bytemuck::pod_collect_to_vec(slots),
            power: header.power(),
            groups: bytemuck::pod_collect_to_vec(groups),
        };
        StoredLightBvh::checked(tree.view(), tree.power)?;
        Ok(tree)
    }
}
