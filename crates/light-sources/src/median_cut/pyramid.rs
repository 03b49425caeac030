use alloc::vec::Vec;

use super::region::TexelRegion;

/// An image pyramid of energy; a texel of level `l` holds the sum over `2^l x 2^l` texels.
#[derive(Clone, Debug)]
pub(super) struct EnergyPyramid {
    levels: Vec<Level>,
}

#[derive(Clone, Debug)]
struct Level {
    sums: Vec<f32>,
    size: [u32; 2],
}

/// The most blocks along a side of a region, without partial ones at its ends.
const BLOCKS: u32 = 8;

impl EnergyPyramid {
    /// The pyramid over the energies of texels, row by row.
    pub(super) fn new(texels: Vec<f32>, size: [u32; 2]) -> Self {
        let mut levels = Vec::new();
        let mut level = Level { sums: texels, size };
        while level.size.iter().any(|&side| side > BLOCKS) {
            let coarser = level.coarser();
            levels.push(level);
            level = coarser;
        }
        levels.push(level);
        Self { levels }
    }

    /// The level for a region and its parts: level 0, which is exact, for small ones.
    pub(super) fn level_for(&self, region: &TexelRegion) -> usize {
        let side = |axis: usize| region.max[axis] - region.min[axis];
        let longest = side(0).max(side(1));
        let fits = |level: &usize| longest >> level <= BLOCKS;
        (0..self.levels.len())
            .find(fits)
            .unwrap_or(self.levels.len() - 1)
    }

    /// The energy of a region, taken as uniform in each block of the given level.
    pub(super) fn energy(&self, region: &TexelRegion, level: usize) -> f64 {
        let Level { sums, size } = &self.levels[level];
        let full = self.levels[0].size;
        let blocks = |axis: usize| region.min[axis] >> level..=(region.max[axis] - 1) >> level;
        // The fraction of a block, cut off at the edge of the image, that the region covers.
        let coverage = |axis: usize, block: u32| {
            let (start, end) = (block << level, ((block + 1) << level).min(full[axis]));
            let covered = end.min(region.max[axis]) - start.max(region.min[axis]);
            f64::from(covered) / f64::from(end - start)
        };
        let row = |y: u32| -> f64 {
            let texels = blocks(0).map(|x| {
                let sum = sums[y as usize * size[0] as usize + x as usize];
                f64::from(sum) * coverage(0, x)
            });
            texels.sum()
        };
        blocks(1).map(|y| row(y) * coverage(1, y)).sum()
    }
}

impl Level {
    fn coarser(&self) -> Self {
        let size = self.size.map(|side| side.div_ceil(2));
        let width = self.size[0] as usize;
        let mut sums = Vec::with_capacity(size[0] as usize * size[1] as usize);
        for rows in self.sums.chunks(2 * width) {
            let (upper, lower) = rows.split_at(width);
            let sum = |row: &[f32], x: usize| row.iter().skip(x).take(2).sum::<f32>();
            sums.extend((0..width).step_by(2).map(|x| sum(upper, x) + sum(lower, x)));
        }
        Self { sums, size }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_add_up_at_every_level() {
        let size = [37, 21];
        let texels: Vec<f32> = (0u16..37 * 21).map(|i| f32::from(i % 11)).collect();
        let total: f64 = texels.iter().map(|&t| f64::from(t)).sum();
        let pyramid = EnergyPyramid::new(texels, size);
        let whole = TexelRegion::whole(size);
        assert_eq!(pyramid.level_for(&whole), 3, "5 x 3 blocks");
        for level in 0..pyramid.levels.len() {
            for axis in [0, 1] {
                let parts = whole.parts(axis, 13);
                let sum: f64 = parts.iter().map(|part| pyramid.energy(part, level)).sum();
                assert!((sum - total).abs() < 1e-6 * total, "level {level}: {sum}");
            }
        }
    }

    #[test]
    fn small_regions_are_exact() {
        let mut texels = alloc::vec![0.0; 64 * 64];
        texels[64 * 20 + 30] = 1.0;
        let pyramid = EnergyPyramid::new(texels, [64, 64]);
        let of = TexelRegion {
            min: [26, 17],
            max: [34, 25],
        };
        let energies = of
            .parts(0, 30)
            .map(|part| pyramid.energy(&part, pyramid.level_for(&of)));
        assert_eq!(energies, [0.0, 1.0], "the texel is right of the cut");
    }
}
