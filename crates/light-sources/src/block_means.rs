use alloc::vec::Vec;

use crate::bilinear_cells::{Shown, single};
use crate::glam::{DVec3, Vec3};
use crate::texture_mapping::Wrap;
use crate::uv_polygon::Axis;

/// Means of an image over blocks of the unit square: a pyramid from blocks of a few texels, doubled
/// at each level, up to the whole.
///
/// Less than a byte per texel. The means are exact, so that integrals need not visit the texels of
/// a block that is covered as a whole.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BlockMeans {
    /// The number of smallest blocks along each axis, as powers of two.
    log2_blocks: [u32; 2],
    /// The wrap rule of the means: half of a texel at each edge depends on it.
    wrap: [Wrap; 2],
    /// Row by row, from the smallest blocks to the whole.
    means: Vec<Vec3>,
}

/// A block of the plane tiled by unit squares: `2^level` smallest blocks along each axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    pub(crate) level: u32,
    pub(crate) index: [i64; 2],
}

/// Texels that the smallest block has along an axis, at most twice as many.
const TEXELS: u32 = 4;

impl BlockMeans {
    pub(crate) fn new(shown: &Shown<'_>) -> Self {
        let log2 = |axis| (shown.texels(axis) / TEXELS).max(1).ilog2();
        let mut blocks = Self {
            log2_blocks: Axis::BOTH.map(log2),
            wrap: shown.wrap,
            means: Vec::new(),
        };
        let size = blocks.size(0);
        blocks.means.reserve(size[0] * size[1] * 4 / 3 + 2);
        for y in 0..size[1] {
            for x in 0..size[0] {
                let corner = |x: usize, y: usize| [x, y].map(|i| i as f64);
                let at = |[x, y]: [f64; 2]| [x / size[0] as f64, y / size[1] as f64];
                let sum = shown.over_rectangle(at(corner(x, y)), at(corner(x + 1, y + 1)));
                blocks.means.push(single(sum * (size[0] * size[1]) as f64));
            }
        }
        let (mut start, mut fine) = (0, size);
        for level in 1..=blocks.levels() {
            let coarse = blocks.size(level);
            let step = [fine[0] / coarse[0], fine[1] / coarse[1]];
            for (y, x) in (0..coarse[1]).flat_map(|y| (0..coarse[0]).map(move |x| (y, x))) {
                let mut sum = DVec3::ZERO;
                for (dy, dx) in (0..step[1]).flat_map(|dy| (0..step[0]).map(move |dx| (dy, dx))) {
                    let row = (y * step[1] + dy) * fine[0];
                    sum += blocks.means[start + row + x * step[0] + dx].as_dvec3();
                }
                blocks.means.push(single(sum / (step[0] * step[1]) as f64));
            }
            start += fine[0] * fine[1];
            fine = coarse;
        }
        blocks
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.means.as_slice())
    }

    /// The level of the whole.
    pub(crate) fn levels(&self) -> u32 {
        self.log2_blocks[0].max(self.log2_blocks[1])
    }

    /// Blocks of a level along each axis of the unit square.
    fn size(&self, level: u32) -> [usize; 2] {
        self.log2_blocks
            .map(|log2| 1usize << log2.saturating_sub(level))
    }

    /// How many of the smallest blocks the unit square has along an axis.
    pub(crate) fn count(&self, axis: Axis) -> f64 {
        (1u64 << self.log2_blocks[axis as usize]) as f64
    }

    /// The mean of the image with `wrap` over a block; `None` if it is not stored.
    pub(crate) fn mean(&self, block: Block, wrap: [Wrap; 2]) -> Option<DVec3> {
        let is_known = Axis::BOTH.into_iter().all(|axis| {
            let axis = axis as usize;
            self.is_known(axis, block.level, block.index[axis], wrap[axis])
        });
        is_known.then(|| self.stored(block, wrap))
    }

    /// The stored mean over a block, the same for every wrap rule.
    pub(crate) fn stored(&self, block: Block, wrap: [Wrap; 2]) -> DVec3 {
        let level = block.level.min(self.levels());
        let start: usize = (0..level).map(|l| self.size(l)).map(|[w, h]| w * h).sum();
        let [x, y] = [0, 1].map(|axis| self.folded(axis, block, wrap[axis]));
        self.means[start + y * self.size(level)[0] + x].as_dvec3()
    }

    /// The block of the unit square that a block of the tiled plane repeats.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_possible_wrap,
        reason = "below the number of blocks"
    )]
    fn folded(&self, axis: usize, block: Block, wrap: Wrap) -> usize {
        let count = self.size(block.level)[axis] as i64;
        let index = block.index[axis];
        let folded = match wrap {
            Wrap::Clamp | Wrap::Black => index.clamp(0, count - 1),
            Wrap::Mirror if index.div_euclid(count) % 2 != 0 => count - 1 - index.rem_euclid(count),
            Wrap::Repeat | Wrap::Mirror => index.rem_euclid(count),
        };
        folded as usize
    }

    /// Whether the means along an axis are valid for `wrap`: always where no edge of the unit
    /// square is near.
    #[expect(clippy::cast_possible_wrap, reason = "at most 2^32 blocks")]
    fn is_known(&self, axis: usize, level: u32, index: i64, wrap: Wrap) -> bool {
        let count = self.size(level)[axis] as i64;
        let index = index.rem_euclid(count);
        let is_inside = index > 0 && index < count - 1;
        is_inside
            || match (self.wrap[axis], wrap) {
                (Wrap::Clamp | Wrap::Mirror, Wrap::Clamp | Wrap::Mirror) => true,
                // Repetition moves the part beyond one edge to the other edge: the mean does not
                // change.
                (Wrap::Clamp, Wrap::Repeat) => count == 1,
                (taken, asked) => taken == asked,
            }
    }
}
