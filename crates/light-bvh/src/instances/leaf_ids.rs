use light_bounds::LightId;

use crate::build::scan::is_addressable;
use crate::instances::prototype::LightPrototype;

/// Which leaf of the upper tree a part of a placement is: those of a placement follow each other,
/// and so many have an id that the parts of every prototype fit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeafIds {
    /// Binary logarithm of the ids of a placement.
    shift: u32,
}

impl LeafIds {
    /// Those of placements of any of these prototypes.
    pub(crate) fn new(prototypes: &[LightPrototype]) -> Self {
        let parts = prototypes.iter().map(|prototype| prototype.parts().len());
        let most = parts.max().unwrap_or(1);
        Self {
            shift: most.next_power_of_two().ilog2(),
        }
    }

    /// How many ids a placement has.
    pub(crate) const fn each(self) -> usize {
        1 << self.shift
    }

    /// How many ids so many placements have.
    pub(crate) const fn of(self, placements: usize) -> usize {
        placements << self.shift
    }

    /// Whether the tree can address so many placements, and so many lights beside them.
    pub(crate) const fn fit(self, placements: usize, lights: usize) -> bool {
        is_addressable(placements) && is_addressable(self.of(placements) + lights)
    }

    /// The leaf of a part of a placement.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "at most 2^28 leaves")]
    pub(crate) const fn leaf(self, placement: u32, part: usize) -> LightId {
        LightId((placement << self.shift) + part as u32)
    }

    /// The position of the placement that a leaf is a part of.
    #[inline(always)]
    pub(crate) const fn placement(self, leaf: u32) -> usize {
        (leaf >> self.shift) as usize
    }

    /// The placement that a leaf is a part of, and which part.
    #[inline(always)]
    pub(crate) const fn part(self, leaf: u32) -> (u32, usize) {
        let part = leaf & ((1 << self.shift) - 1);
        (leaf >> self.shift, part as usize)
    }
}
