//! Lights along a Morton curve: neighbours on it are neighbours in space.

use alloc::vec::Vec;

use light_bounds::{LightBounds, LightExtent};
use light_math::Aabb;
use light_math::glam::Vec3;

use crate::build::lights::{Lights, phi};
use crate::build::morton_entry::MortonEntry;
use crate::build::options::DarkLights;
use crate::build::radix_sort as radix;
use crate::build::scan::is_held;
use crate::parallel::map;

/// Bits of a key for each axis.
const BITS: u32 = 21;

/// Bits of a key.
#[cfg(all(feature = "std", feature = "bytemuck"))]
pub(crate) const KEY_BITS: u32 = 3 * BITS;

/// The cells that keys number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    low: Vec3,
    /// Side of the smallest cells.
    pub(crate) cell: f32,
    inv_cell: f32,
}

impl Grid {
    /// Cubic cells that fill the longest side of `bounds`; `None` if that is too short to divide.
    pub(crate) fn new(bounds: &Aabb) -> Option<Self> {
        const FLAT: f32 = 1e-30;
        let side = bounds.diagonal().max_element();
        let cell = side / (1u32 << BITS) as f32;
        (cell > FLAT).then(|| Self {
            low: bounds.min,
            cell,
            inv_cell: 1.0 / cell,
        })
    }

    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "float to integer casts saturate"
    )]
    pub(crate) fn key(&self, p: Vec3) -> u64 {
        let place = ((p - self.low) * self.inv_cell).to_array();
        let [x, y, z] = place.map(|x| spread((x as u32).min((1 << BITS) - 1)));
        x << 2 | y << 1 | z
    }
}

/// The low 21 bits of `x`, two zeros behind each.
#[inline]
const fn spread(x: u32) -> u64 {
    let mut x = x as u64;
    x = (x | x << 32) & 0x001f_0000_0000_ffff;
    x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

/// The lights that the tree holds, along the curve through `centers`; the side of the smallest
/// cells.
pub(crate) fn sorted(
    extents: &[LightExtent],
    lights: &Lights<'_>,
    centers: &Aabb,
    dark: DarkLights,
) -> (Vec<MortonEntry>, f32) {
    let grid = Grid::new(centers);
    let chunks: Vec<(u32, &[LightExtent])> = (0..)
        .step_by(radix::CHUNK)
        .zip(extents.chunks(radix::CHUNK))
        .collect();
    let chunks = map(chunks, |(first, chunk)| {
        let bounded = (first..)
            .zip(chunk)
            .filter_map(|(i, e)| Some((i, e, e.bounded()?)));
        let held = bounded.filter(|(_, extent, _)| is_held(phi(extent), dark));
        let entry = |(light, extent, bounds): (u32, &LightExtent, &LightBounds)| MortonEntry {
            key: grid.map_or(0, |grid| grid.key(bounds.bounds.center())),
            light,
            power: lights.share(extent),
        };
        let mut entries = Vec::with_capacity(chunk.len());
        entries.extend(held.map(entry));
        entries
    });
    (radix::sorted(chunks), grid.map_or(0.0, |grid| grid.cell))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_interleaved() {
        assert_eq!(spread(0b1011), 0b1_000_001_001, "bits apart");
        assert_eq!(spread((1 << BITS) - 1), 0x1249_2492_4924_9249, "all bits");
        let grid = Grid::new(&Aabb::new(Vec3::ZERO, Vec3::splat(8.0))).expect("not flat");
        assert_eq!(grid.key(Vec3::ZERO), 0, "the lowest corner");
        assert_eq!(grid.key(Vec3::splat(8.0)), (1 << 63) - 1, "the highest");
        assert_eq!(grid.key(Vec3::new(4.0, 0.0, 0.0)), 1 << 62, "half way");
    }

    #[test]
    fn a_point_has_no_cells() {
        assert!(Grid::new(&Aabb::from_point(Vec3::ONE)).is_none(), "no side");
    }
}
