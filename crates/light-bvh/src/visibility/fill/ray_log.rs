use alloc::vec::Vec;

use light_bounds::LightId;

use crate::node::wide_node::{MAX_DEPTH, WIDTH};
use crate::query::bvh_ref::LightBvhRef;
use crate::visibility::cell_key::CellKey;
use crate::visibility::way::Way;

/// Bits of a child's number.
const CHILD_BITS: usize = 4;

const _: () = assert!(1 << CHILD_BITS == WIDTH, "a child in so many bits");
const _: () = assert!(CHILD_BITS * MAX_DEPTH <= 96, "32 bits are left");

/// A ray: the place that it was sent from, the path of its light, and whether that was seen.
///
/// The root's child is in the highest bits, the lowest one says whether it was seen, and the 31
/// above that hold the place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

    /// The number of the place.
    const fn place(self) -> usize {
        (self.0 >> 1) as usize & 0x7fff_ffff
    }
}

/// The rays of a cell, in the order in which they were sent.
#[derive(Clone, Debug, Default)]
pub(super) struct RayLog {
    rays: Vec<Ray>,
    dark: usize,
}

/// The rays that filled a coarse cell, in the order of the fine cells that they start in, and the
/// fine cell of each place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct CoarseRays {
    rays: Vec<Ray>,
    places: Vec<CellKey>,
}

impl RayLog {
    /// Adds a ray from a place to a light of the tree; `None` if the light emits nothing toward
    /// it.
    pub(super) fn push(
        &mut self,
        tree: &LightBvhRef<'_>,
        (place, light): (u32, LightId),
        is_seen: Option<bool>,
    ) {
        let Some(way) = Way::of(tree, light) else {
            return;
        };
        self.dark += usize::from(is_seen.is_none());
        let mut bits = u128::from(place & 0x7fff_ffff) << 1 | u128::from(is_seen == Some(true));
        for (level, (_, child)) in way.down().enumerate() {
            bits |= (child as u128) << (128 - CHILD_BITS * (level + 1));
        }
        self.rays.push(Ray(bits));
    }

    pub(super) fn rays(&self) -> &[Ray] {
        &self.rays
    }

    /// Whether so large a share of the lights that emit toward their places is seen.
    pub(super) fn is_open(&self, share: f32) -> bool {
        let seen = self.rays.iter().filter(|ray| ray.is_seen()).count();
        seen as f32 >= share * (self.rays.len() - self.dark) as f32
    }
}

impl CoarseRays {
    /// No rays.
    pub(super) const NONE: Self = Self {
        rays: Vec::new(),
        places: Vec::new(),
    };

    /// The rays of this log from `places`, each in the fine cell of its key.
    pub(super) fn new(log: RayLog, places: Vec<CellKey>) -> Self {
        let mut rays = log.rays;
        rays.sort_by_key(|ray| places.get(ray.place()));
        Self { rays, places }
    }

    /// Those from places in a fine cell.
    pub(super) fn of(&self, fine: CellKey) -> impl Iterator<Item = Ray> {
        let cell = move |ray: &Ray| self.places.get(ray.place());
        let first = self.rays.partition_point(|ray| cell(ray) < Some(&fine));
        let rays = self.rays[first..].iter().copied();
        rays.take_while(move |ray| cell(ray) == Some(&fine))
    }
}
