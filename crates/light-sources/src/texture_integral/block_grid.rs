use crate::bilinear_cells::Shown;
use crate::block_means::{Block, BlockMeans};
use crate::floor::floor;
use crate::glam::{DVec2, DVec3};
use crate::texture_mapping::Wrap;
use crate::uv_polygon::{Axis, UvPolygon};

/// The blocks of texels of an image, and where they lie in it.
pub(super) struct BlockGrid<'a> {
    pub(super) shown: &'a Shown<'a>,
    pub(super) blocks: &'a BlockMeans,
}

impl BlockGrid<'_> {
    /// The lower edge of a block.
    pub(super) fn edge(&self, axis: Axis, level: u32, index: i64) -> f64 {
        index as f64 * (1u64 << level) as f64 / self.blocks.count(axis)
    }

    /// The finest level of which at most two blocks along each axis cover a rectangle, with the
    /// first and the last of them.
    pub(super) fn covering(&self, [min, max]: [DVec2; 2]) -> (u32, [[i64; 2]; 2]) {
        let index = |p: DVec2| Axis::BOTH.map(|axis| whole(axis.of(p) * self.blocks.count(axis)));
        let (mut low, mut high) = (index(min), index(max));
        let mut level = 0;
        while (0..2).any(|i| high[i] - low[i] > 1) {
            (low, high) = (low.map(|i| i >> 1), high.map(|i| i >> 1));
            level += 1;
        }
        (level, [low, high])
    }

    /// The sum of nearby texels: above 0 if a lookup in single precision in the polygon may find
    /// any light.
    pub(super) fn near(&self, polygon: &UvPolygon) -> DVec3 {
        let [min, max] = polygon.place_bounds();
        let size = Axis::BOTH.map(|axis| f64::from(self.shown.texels(axis)));
        let reach = 1.0 / DVec2::from_array(size) + 1e-6 * (1.0 + min.abs().max(max.abs()));
        let bounds = [min - reach, max + reach];
        let is_beyond = |axis: Axis| {
            let [min, max] = bounds.map(|p| axis.of(p));
            self.shown.wrap[axis as usize] == Wrap::Black
                && (min > 1.0 + axis.of(reach) || max < -axis.of(reach))
        };
        if Axis::BOTH.into_iter().any(is_beyond) {
            return DVec3::ZERO;
        }
        let (level, [low, high]) = self.covering(bounds);
        let mut sum = DVec3::ZERO;
        for y in low[1]..=high[1] {
            for x in low[0]..=high[0] {
                let index = [x, y];
                sum += self.blocks.stored(Block { level, index }, self.shown.wrap);
            }
        }
        sum
    }
}

/// The whole number at or below a position near to the origin.
#[expect(
    clippy::cast_possible_truncation,
    reason = "saturates where there is nothing any more"
)]
fn whole(x: f64) -> i64 {
    floor(x) as i64
}
