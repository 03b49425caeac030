use core::ops::Range;

use super::World;
use crate::PrimitiveId;

impl World {
    /// The number of triangles, those of prototypes counted once per instance.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.count(|[triangles, _]| triangles.len())
    }

    /// The number of quadrics, those of prototypes counted once per instance.
    #[must_use]
    pub(crate) fn quadric_count(&self) -> usize {
        self.count(|[_, quadrics]| quadrics.len())
    }

    /// The number of stored triangles, those of prototypes counted once.
    #[must_use]
    pub fn stored_triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// The number of stored quadrics, those of prototypes counted once.
    #[must_use]
    pub fn stored_quadric_count(&self) -> usize {
        self.quadrics.len()
    }

    /// The number of prototypes.
    #[must_use]
    pub fn prototype_count(&self) -> usize {
        self.accel.prototype_count()
    }

    /// The number of instances of all prototypes.
    #[must_use]
    pub fn instance_count(&self) -> usize {
        self.accel.instances().len()
    }

    /// The `n`th of all triangles and quadrics, those of prototypes counted once per instance;
    /// `None` beyond the last.
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
            .zip(self.accel.instances())
            .find_map(|(instance, ranges)| Some(PrimitiveId::in_instance(among(ranges)?, instance)))
    }

    /// All triangles and quadrics, those of prototypes once per instance, in the order of
    /// [`primitive`](Self::primitive).
    pub(crate) fn primitives(&self) -> impl Iterator<Item = PrimitiveId> {
        let world = self.accel.world().into_iter().flatten();
        let instances = (0u32..).zip(self.accel.instances());
        let in_instances = instances.flat_map(|(instance, ranges)| {
            let numbers = ranges.into_iter().flatten();
            numbers.map(move |number| PrimitiveId::in_instance(number, instance))
        });
        world.map(PrimitiveId::new).chain(in_instances)
    }

    /// The sum of `of` over the ranges of world space and of every instance.
    fn count(&self, of: impl Fn([Range<u32>; 2]) -> usize) -> usize {
        of(self.accel.world()) + self.accel.instances().map(of).sum::<usize>()
    }
}
