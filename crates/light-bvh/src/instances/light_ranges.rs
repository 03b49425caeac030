use alloc::vec::Vec;

use light_bounds::LightId;

use crate::instances::placed_light::PlacedLight;

/// The numbers of placed lights: those of the first placement, then those of the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct LightRanges {
    /// Where the lights of each placement end.
    ends: Vec<u64>,
}

impl LightRanges {
    /// The numbers of the lights of placements with so many lights each.
    pub(crate) fn new(counts: impl Iterator<Item = usize>) -> Self {
        let mut end = 0;
        let ends = counts.map(|count| {
            end += count as u64;
            end
        });
        Self {
            ends: ends.collect(),
        }
    }

    /// How many lights there are.
    pub(crate) fn count(&self) -> u64 {
        self.ends.last().copied().unwrap_or(0)
    }

    /// The number of `light`, if it is one of the lights.
    pub(crate) fn index(&self, light: PlacedLight) -> Option<u64> {
        let placement = light.placement as usize;
        let end = *self.ends.get(placement)?;
        let start = placement
            .checked_sub(1)
            .map_or(0, |before| self.ends[before]);
        let index = start + u64::from(light.light.0);
        (index < end).then_some(index)
    }

    /// The light of the number `index`, if there is one.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "at most 2^28 placements, and 2^28 lights of each"
    )]
    pub(crate) fn light(&self, index: u64) -> Option<PlacedLight> {
        let placement = self.ends.partition_point(|&end| end <= index);
        if placement == self.ends.len() {
            return None;
        }
        let start = placement
            .checked_sub(1)
            .map_or(0, |before| self.ends[before]);
        Some(PlacedLight {
            placement: placement as u32,
            light: LightId((index - start) as u32),
        })
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.ends)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_lights_belong_to_each_other() {
        let ranges = LightRanges::new([3, 0, 2, 0].into_iter());
        assert_eq!(ranges.count(), 5, "3 + 2");
        let all: Vec<_> = (0..5).map(|i| ranges.light(i).expect("a light")).collect();
        let pairs: Vec<_> = all.iter().map(|l| (l.placement, l.light.0)).collect();
        assert_eq!(pairs, [(0, 0), (0, 1), (0, 2), (2, 0), (2, 1)], "in order");
        for (index, &light) in (0..).zip(&all) {
            assert_eq!(ranges.index(light), Some(index), "and back");
        }
        assert_eq!(ranges.light(5), None, "no sixth");
        for (placement, light) in [(0, 3), (1, 0), (2, 2), (3, 0), (4, 0), (u32::MAX, 0)] {
            let light = LightId(light);
            let none = PlacedLight { placement, light };
            assert_eq!(ranges.index(none), None, "{none:?}");
        }
    }

    #[test]
    fn more_lights_than_32_bits_count() {
        let ranges = LightRanges::new([1 << 28; 100].into_iter());
        let last = PlacedLight {
            placement: 99,
            light: LightId((1 << 28) - 1),
        };
        assert_eq!(ranges.index(last), Some(100 * (1 << 28) - 1), "the last");
        assert_eq!(ranges.light(100 * (1 << 28) - 1), Some(last), "and back");
    }
}
