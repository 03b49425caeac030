use core::ops::Range;

use super::World;
use crate::PrimitiveId;

impl World {
    /// How many triangles there are to be seen: those of prototypes in each of their places.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.count(|[triangles, _]| triangles.len())
    }

    /// How many spheres there are to be seen: those of prototypes in each of their places.
    #[must_use]
    pub fn sphere_count(&self) -> usize {
        self.count(|[_, spheres]| spheres.len())
    }

    /// How many triangles are stored.
    #[must_use]
    pub fn stored_triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// How many spheres are stored.
    #[must_use]
    pub fn stored_sphere_count(&self) -> usize {
        self.spheres.len()
    }

    /// How many objects are stored once and stand in several places.
    #[must_use]
    pub fn prototype_count(&self) -> usize {
        self.accel.prototype_count()
    }

    /// In how many places they stand, all together.
    #[must_use]
    pub fn placement_count(&self) -> usize {
        self.accel.placements().len()
    }

    /// The `n`th of all triangles and spheres that there are to be seen.
    #[must_use]
    pub fn primitive(&self, mut n: usize) -> Option<PrimitiveId> {
        let mut among = |ranges: [Range<u32>; 2]| {
            ranges.into_iter().find_map(|mut numbers| {
                let here = n;
                n = n.saturating_sub(numbers.len());
                numbers.nth(here)
            })
        };
        if let Some(number) = among(self.accel.world()) {
            return Some(PrimitiveId::new(number));
        }
        (0u32..)
            .zip(self.accel.placements())
            .find_map(|(placement, ranges)| Some(PrimitiveId::placed(among(ranges)?, placement)))
    }

    /// Adds up what `of` counts where things stand where they are stored, and in every placement.
    fn count(&self, of: impl Fn([Range<u32>; 2]) -> usize) -> usize {
        of(self.accel.world()) + self.accel.placements().map(of).sum::<usize>()
    }
}
