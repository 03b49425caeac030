use alloc::vec::Vec;

use light_bounds::LightId;

use crate::node::wide_node::{MAX_DEPTH, WIDTH};
use crate::query::bvh_ref::LightBvhRef;
use crate::visibility::way::Way;

/// Bits of a child's number.
const CHILD_BITS: usize = 4;

const _: () = assert!(1 << CHILD_BITS == WIDTH, "a child in so many bits");
const _: () = assert!(CHILD_BITS * MAX_DEPTH < 128, "a bit is left");

/// A ray: the path of the light that it was sent to, and whether that was seen.
///
/// The root's child is in the highest bits, the lowest one says whether it was seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray(u128);

impl Ray {
    /// The child on the path at this level of the tree; 0 beyond the light.
    pub(super) const fn child(self, level: usize) -> usize {
        let shift = 128 - CHILD_BITS * (level + 1);
        (self.0 >> shift) as usize & (WIDTH - 1)
    }

    pub(super) const fn is_seen(self) -> bool {
        self.0 & 1 == 1
    }
}

/// The rays of a cell, in the order in which they were sent.
#[derive(Clone, Debug, Default)]
pub(super) struct RayLog {
    rays: Vec<Ray>,
}

impl RayLog {
    /// Adds a ray to a light of the tree.
    pub(super) fn push(&mut self, tree: &LightBvhRef<'_>, light: LightId, is_seen: bool) {
        let Some(way) = Way::of(tree, light) else {
            return;
        };
        let mut bits = u128::from(is_seen);
        for (level, (_, child)) in way.down().enumerate() {
            bits |= (child as u128) << (128 - CHILD_BITS * (level + 1));
        }
        self.rays.push(Ray(bits));
    }

    pub(super) fn rays(&self) -> &[Ray] {
        &self.rays
    }

    /// How many of the rays were not blocked.
    pub(super) fn seen(&self) -> usize {
        self.rays.iter().filter(|ray| ray.is_seen()).count()
    }
}
