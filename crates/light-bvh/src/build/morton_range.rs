use light_math::Aabb;

use crate::build::lights::Lights;
use crate::build::morton::Grid;
use crate::build::morton_entry::MortonEntry;
use crate::build::radix_sort;
use crate::build::split_group::SplitGroup;
use crate::build::subtree::{OutputSlice, ParallelGroup};
use crate::build::topology::Topology;
use crate::parallel::map;

/// A range of lights along the curve.
#[derive(Debug)]
pub(crate) struct MortonRange<'a> {
    entries: &'a mut [MortonEntry],
    lights: &'a Lights<'a>,
    /// Side of the smallest cells of the keys.
    cell: f32,
}

impl<'a> MortonRange<'a> {
    /// The lights of `entries`, which are in the order of their keys.
    pub(crate) const fn new(
        entries: &'a mut [MortonEntry],
        lights: &'a Lights<'a>,
        cell: f32,
    ) -> Self {
        Self {
            entries,
            lights,
            cell,
        }
    }

    /// Gives the lights of one cell new keys in a finer grid.
    fn refine_keys(&mut self) {
        let center = |e: &MortonEntry| self.lights.bounds(e.light).bounds.center();
        let bounds = Aabb::from_points(self.entries.iter().map(center));
        if let Some(grid) = Grid::new(&bounds) {
            for entry in self.entries.iter_mut() {
                entry.key = grid.key(self.lights.bounds(entry.light).bounds.center());
            }
            radix_sort::sort(self.entries);
            self.cell = grid.cell;
        }
    }

    fn split_at(self, middle: usize) -> (Self, Self) {
        let (left, right) = self.entries.split_at_mut(middle);
        (
            Self::new(left, self.lights, self.cell),
            Self::new(right, self.lights, self.cell),
        )
    }
}

impl SplitGroup for MortonRange<'_> {
    fn lights(&self) -> usize {
        self.entries.len()
    }

    fn is_divisible(&self) -> bool {
        self.entries.len() > 1
    }

    /// The side of the smallest cell that holds the lights.
    fn size(&self) -> f32 {
        const THIRDS: [f32; 3] = [1.0, 1.259_921, 1.587_401];
        let bits = top_bit(self.entries).map_or(0, |bit| bit + 1);
        let side = (1u32 << (bits / 3)) as f32 * THIRDS[bits as usize % 3];
        side * self.cell.max(f32::MIN_POSITIVE)
    }

    fn power(&self) -> f32 {
        power(self.entries)
    }

    /// Power times size.
    fn cost(&self) -> f32 {
        self.power() * self.size()
    }

    fn split(mut self) -> (Self, Self) {
        if top_bit(self.entries).is_none() {
            self.refine_keys();
        }
        match top_bit(self.entries) {
            Some(bit) => {
                let middle = self.entries.partition_point(|e| e.key >> bit & 1 == 0);
                self.split_at(middle)
            }
            None => self.halve(),
        }
    }

    fn halve(self) -> (Self, Self) {
        let middle = self.entries.len() / 2;
        self.split_at(middle)
    }

    fn each_light(&self, each: impl FnMut(u32)) {
        self.entries.iter().map(|e| e.light).for_each(each);
    }
}

/// The highest bit in which keys differ; `None` if all agree.
fn top_bit(entries: &[MortonEntry]) -> Option<u32> {
    let (first, last) = (entries.first()?, entries.last()?);
    (first.key ^ last.key).checked_ilog2()
}

/// The power of all entries, in parallel where they are many.
fn power(entries: &[MortonEntry]) -> f32 {
    /// Entries that one job adds up.
    const CHUNK: usize = 1 << 14;
    if entries.len() <= CHUNK {
        return power_of_few(entries);
    }
    map(entries.chunks(CHUNK).collect(), power_of_few)
        .iter()
        .sum()
}

/// The same in four independent sums.
fn power_of_few(entries: &[MortonEntry]) -> f32 {
    let fours = entries.chunks_exact(4);
    let rest: f32 = fours.remainder().iter().map(|e| e.power).sum();
    let mut sums = [0.0; 4];
    for four in fours {
        for (sum, entry) in sums.iter_mut().zip(four) {
            *sum += entry.power;
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

impl ParallelGroup for MortonRange<'_> {
    const MAX_SERIAL_LIGHTS: usize = 2048;

    fn build_subtree(self, output: OutputSlice<'_>) -> Topology {
        output.build_serial(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four at a time and what is left over.
    #[test]
    fn power_is_the_sum() {
        let entry = |i: u16| MortonEntry {
            key: 0,
            light: 0,
            power: f32::from(i),
        };
        for count in [0, 3, 4, 11] {
            let entries: alloc::vec::Vec<_> = (1..=count).map(entry).collect();
            let sum = f32::from(count * (count + 1) / 2);
            assert_eq!(power(&entries), sum, "{count} entries");
        }
    }
}
