use alloc::vec::Vec;
use core::ops::Range;

use crate::light_kinds::LightKind;
use light_bounds::{LightGroups, LightId};

/// Identifies a description of a set by the order of adding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SourceId(pub u32);

/// Where a source is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SourcePlace {
    /// Its kind, and its index in the list of that kind.
    Listed { kind: LightKind, index: u32 },
    /// The number of a placement of a mesh.
    Placed(u32),
}

/// The sources of a set in the order of adding, and the ids of their lights, which run through
/// them. 12 bytes a source, and 4 for every 64 lights.
#[derive(Clone, Debug)]
pub(crate) struct SourceTable {
    places: Vec<SourcePlace>,
    /// How many lights there are up to and with each source.
    ends: Vec<u32>,
    /// The source of every [`STRIDE`]th light: bounds for the search of the others.
    source_of: Vec<u32>,
    /// The groups of the first sources; the others are in all groups.
    groups: Vec<LightGroups>,
}

/// Lights per entry of the table that bounds the search for a source.
const STRIDE: usize = 64;

impl SourceTable {
    pub(crate) const EMPTY: Self = Self {
        places: Vec::new(),
        ends: Vec::new(),
        source_of: Vec::new(),
        groups: Vec::new(),
    };

    /// Adds a source of `lights` lights; `None` where 32 bits do not suffice for the ids.
    pub(crate) fn add(&mut self, place: SourcePlace, lights: usize) -> Option<SourceId> {
        let source = u32::try_from(self.places.len()).ok()?;
        let end = self.lights().checked_add(u32::try_from(lights).ok()?)?;
        self.source_of
            .resize((end as usize).div_ceil(STRIDE), source);
        self.ends.push(end);
        self.places.push(place);
        Some(SourceId(source))
    }

    /// The number of lights of all sources.
    #[inline]
    pub(crate) fn lights(&self) -> u32 {
        self.ends.last().copied().unwrap_or(0)
    }

    /// Where a source is stored.
    #[inline]
    pub(crate) fn place(&self, source: SourceId) -> Option<SourcePlace> {
        self.places.get(source.0 as usize).copied()
    }

    /// The ids of the lights of a source.
    #[inline]
    pub(crate) fn ids(&self, source: SourceId) -> Option<Range<u32>> {
        let end = *self.ends.get(source.0 as usize)?;
        let before = source.0.checked_sub(1);
        Some(before.map_or(0, |source| self.ends[source as usize])..end)
    }

    /// The source of a light, and the light's number there.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "sources have 32 bits")]
    pub(crate) fn find(&self, LightId(light): LightId) -> Option<(SourceId, u32)> {
        if light >= self.lights() {
            return None;
        }
        let block = light as usize / STRIDE;
        let low = self.source_of[block] as usize;
        let next = self.source_of.get(block + 1);
        let high = next.map_or(self.ends.len() - 1, |&source| source as usize);
        let between = &self.ends[low..high];
        let source = low + between.partition_point(|&end| end <= light);
        let first = source.checked_sub(1).map_or(0, |before| self.ends[before]);
        Some((SourceId(source as u32), light - first))
    }

    /// Sets the groups of a source; `None` for an unknown one.
    pub(crate) fn set_groups(&mut self, source: SourceId, groups: LightGroups) -> Option<()> {
        let index = source.0 as usize;
        self.places.get(index)?;
        if self.groups.len() <= index {
            self.groups.resize(index + 1, LightGroups::ALL);
        }
        self.groups[index] = groups;
        Some(())
    }

    /// The ids and the groups of the sources that may not be in all groups.
    pub(crate) fn groups(&self) -> impl Iterator<Item = (Range<u32>, LightGroups)> {
        let sources = (0..).map(SourceId).zip(&self.groups);
        sources.filter_map(|(source, &groups)| Some((self.ids(source)?, groups)))
    }

    pub(crate) fn bytes(&self) -> usize {
        let places = size_of_val(&*self.places) + size_of_val(&*self.ends);
        places + size_of_val(&*self.source_of) + size_of_val(&*self.groups)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sources_take_no_more_ids_than_32_bits_count() {
        let place = SourcePlace::Listed {
            kind: LightKind::Triangle,
            index: 0,
        };
        let mut sources = SourceTable::EMPTY;
        assert_eq!(sources.add(place, 70), Some(SourceId(0)), "few");
        for lights in [u32::MAX as usize - 69, usize::MAX] {
            assert_eq!(sources.add(place, lights), None, "{lights} more");
            assert_eq!(sources.lights(), 70, "{lights} more changed the set");
        }
        assert_eq!(sources.add(place, 3), Some(SourceId(1)), "few more");
        assert_eq!(
            sources.find(LightId(72)),
            Some((SourceId(1), 2)),
            "the last"
        );
    }
}
