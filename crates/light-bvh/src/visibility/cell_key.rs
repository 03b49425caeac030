use light_bounds::LightSampleContext;
use light_math::Aabb;
use light_math::float::floor;
use light_math::glam::Vec3;

use crate::visibility::hash::mix;

/// The origin of the grid of fine cells in fine cells, and that of the coarse grid in eighths of a
/// coarse cell.
///
/// Even numbers and a fraction near 0.88: planes at multiples of a quarter of either size lie
/// inside cells, at least a tenth of the size from their border.
const OFFSET: Vec3 = Vec3::new(0.894_427, 2.888_819, 4.877_496);

/// Fine cells along the edge of a coarse one: 2^3.
const FINE_BITS: i32 = 3;

/// The sizes of coarse cells: 2^-100 to 2^100.
const MAX_LEVEL: i32 = 100;

/// What is added to a level, so that it is positive.
const LEVEL_BIAS: i32 = 128;

/// The face of receivers without a normal.
const NO_FACE: u32 = 6;

/// A cell of space: a quantised position, the side that the normal faces, and a size. Fine cells
/// are an eighth as large as coarse ones, and each lies in one of them.
///
/// Keys are whole numbers, the same on every machine: they are made from floats by products with
/// powers of two, sums and `floor` only. 16 bytes.
///
/// ```
/// # use light_bvh::visibility::CellKey;
/// # use light_bvh::light_bounds::{LightSampleContext, glam::Vec3};
/// let floor = |x| LightSampleContext::surface(Vec3::new(x, 2.0, 0.0), Vec3::Z, Vec3::Z);
/// let [here, there] = [1.0, 1.4].map(|x| CellKey::fine(&floor(x), 2.0));
/// assert_ne!(here, there);
/// assert_eq!(here.coarse(), there.coarse());
/// ```
///
/// # Source
/// Keys of position and normal are those of `[Binder2019]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(C)]
pub struct CellKey {
    /// Level, face, and in bit 0 whether it is coarse.
    kind: u32,
    at: [i32; 3],
}

impl CellKey {
    /// The fine cell that `ctx` lies in, where coarse cells are as large as the power of two that
    /// is nearest to `coarse_size`, within `[2^-100, 2^100]` scene units.
    ///
    /// Of a segment it is the cell of its origin. Positions beyond 2^31 fine cells from the origin
    /// share the last of them, and what is not a number counts as 0.
    #[inline]
    #[must_use]
    pub fn fine(ctx: &LightSampleContext, coarse_size: f32) -> Self {
        let level = nearest_level(coarse_size);
        let face = ctx.ns().map_or(NO_FACE, face_of);
        let at = ctx.p * power_of_two(FINE_BITS - level) + OFFSET;
        Self {
            kind: unsigned(level + LEVEL_BIAS) << 8 | face << 1,
            at: at.to_array().map(floor_to_i32),
        }
    }

    /// The three fine cells of the same facing that share a wall with the cell of `ctx` and are
    /// nearest to it on each axis, the nearest one first; `coarse_size` as in [`fine`](Self::fine).
    #[must_use]
    pub fn nearest_neighbours(ctx: &LightSampleContext, coarse_size: f32) -> [Self; 3] {
        let own = Self::fine(ctx, coarse_size);
        let at = ctx.p * power_of_two(FINE_BITS - nearest_level(coarse_size)) + OFFSET;
        let from_middle = (at.to_array()).map(|at| at - floor(at) - 0.5);
        let mut axes = [0, 1, 2];
        axes.sort_unstable_by(|&a, &b| {
            let nearer = f32::total_cmp(&from_middle[b].abs(), &from_middle[a].abs());
            nearer.then(a.cmp(&b))
        });
        axes.map(|axis| {
            let mut neighbour = own;
            let step = if from_middle[axis] < 0.0 { -1 } else { 1 };
            neighbour.at[axis] = neighbour.at[axis].saturating_add(step);
            neighbour
        })
    }

    /// The coarse cell that holds this one; itself if it is coarse.
    #[inline]
    #[must_use]
    pub const fn coarse(self) -> Self {
        if self.is_coarse() {
            return self;
        }
        let [x, y, z] = self.at;
        Self {
            kind: self.kind | 1,
            at: [x >> FINE_BITS, y >> FINE_BITS, z >> FINE_BITS],
        }
    }

    /// Whether it is a coarse cell.
    #[inline]
    #[must_use]
    pub const fn is_coarse(self) -> bool {
        self.kind & 1 == 1
    }

    /// The length of its edges, in scene units.
    #[must_use]
    pub const fn size(self) -> f32 {
        let [_, level, ..] = self.kind.to_le_bytes();
        let finer = if self.is_coarse() { 0 } else { FINE_BITS };
        power_of_two(level as i32 - LEVEL_BIAS - finer)
    }

    /// The cube of space that it covers, up to rounding.
    #[must_use]
    pub fn bounds(self) -> Aabb {
        let [x, y, z] = self.at.map(|at| at as f32);
        let offset = if self.is_coarse() {
            OFFSET * power_of_two(-FINE_BITS)
        } else {
            OFFSET
        };
        let min = Vec3::new(x, y, z) - offset;
        Aabb {
            min: min * self.size(),
            max: (min + Vec3::ONE) * self.size(),
        }
    }

    /// The direction that normals in the cell face more than any other axis, of the six along the
    /// axes; `None` for receivers without a normal.
    #[must_use]
    pub const fn facing(self) -> Option<Vec3> {
        const FACES: [Vec3; 6] = [
            Vec3::X,
            Vec3::NEG_X,
            Vec3::Y,
            Vec3::NEG_Y,
            Vec3::Z,
            Vec3::NEG_Z,
        ];
        let face = (self.kind >> 1 & 0x7f) as usize;
        if face < FACES.len() {
            Some(FACES[face])
        } else {
            None
        }
    }

    /// A number that depends on every bit of the key: the seed of all random numbers of its cell.
    #[inline]
    #[must_use]
    pub const fn seed(self) -> u64 {
        let [x, y, z] = self.at;
        let low = (unsigned(y) as u64) << 32 | unsigned(x) as u64;
        let high = (unsigned(z) as u64) << 32 | self.kind as u64;
        mix(mix(low) ^ high)
    }
}

/// The exponent of the power of two nearest to `size`, in proportion, of `-100..=100`.
#[inline]
fn nearest_level(size: f32) -> i32 {
    if !(size > 0.0) {
        return -MAX_LEVEL;
    }
    let [_, _, low, high] = (size * core::f32::consts::SQRT_2).to_bits().to_le_bytes();
    let exponent = i32::from(high) << 1 | i32::from(low >> 7);
    (exponent - 127).clamp(-MAX_LEVEL, MAX_LEVEL)
}

/// Twice the axis of the largest component of a vector, the first of equal ones, and 1 more if it
/// is negative.
#[inline]
fn face_of(ns: Vec3) -> u32 {
    let [x, y, z] = ns.abs().to_array();
    if x >= y && x >= z {
        u32::from(ns.x < 0.0)
    } else if y >= z {
        2 + u32::from(ns.y < 0.0)
    } else {
        4 + u32::from(ns.z < 0.0)
    }
}

/// `2^exponent`; the exponent is of `-126..=127`.
#[inline]
const fn power_of_two(exponent: i32) -> f32 {
    f32::from_bits(unsigned(exponent + 127) << 23)
}

/// The bits of a whole number.
#[inline]
const fn unsigned(x: i32) -> u32 {
    u32::from_ne_bytes(x.to_ne_bytes())
}

#[inline]
#[expect(
    clippy::cast_possible_truncation,
    reason = "the cast saturates, and sends not a number to 0"
)]
fn floor_to_i32(x: f32) -> i32 {
    floor(x) as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(p: Vec3, n: Vec3, size: f32) -> CellKey {
        CellKey::fine(&LightSampleContext::surface(p, n, n), size)
    }

    #[test]
    fn cells_hold_their_points_and_coarse_cells_their_fine_ones() {
        for i in 0..4000u16 {
            let t = f32::from(i);
            let p = Vec3::new(t * 0.37 - 700.0, t * 7.0 % 5.0 - 2.0, t * 3.1 % 11.0 - 6.0);
            for size in [0.3, 1.0, 5.0, 300.0] {
                let fine = key(p, Vec3::Y, size);
                let coarse = fine.coarse();
                assert_eq!(fine.size() * 8.0, coarse.size(), "{size}");
                for (cell, key) in [fine, coarse].map(|key| (key.bounds(), key)) {
                    let slack = 1e-6 * p.abs().max_element();
                    let within = p.cmpge(cell.min - slack) & p.cmple(cell.max + slack);
                    assert!(within.all(), "{p} in {key:?}: {cell:?}");
                }
                let middle = 0.5 * (fine.bounds().min + fine.bounds().max);
                assert_eq!(key(middle, Vec3::Y, size).coarse(), coarse, "{p}, {size}");
                assert_eq!(coarse.coarse(), coarse, "a coarse cell is its own");
            }
        }
    }

    #[test]
    fn planes_at_round_coordinates_lie_inside_cells() {
        for quarter in -40..=40i8 {
            let p = Vec3::splat(0.25 * f32::from(quarter));
            for cell in [key(p, Vec3::X, 1.0), key(p, Vec3::X, 1.0).coarse()] {
                let (bounds, size) = (cell.bounds(), cell.size());
                let least = (p - bounds.min).min(bounds.max - p).min_element() / size;
                assert!(least > 0.1, "{p}: {least} of {cell:?}");
            }
        }
    }

    #[test]
    fn normals_face_one_of_six_sides() {
        for axis in [
            Vec3::X,
            Vec3::NEG_X,
            Vec3::Y,
            Vec3::NEG_Y,
            Vec3::Z,
            Vec3::NEG_Z,
        ] {
            let tilted = (axis + Vec3::new(0.3, -0.2, 0.25)).normalize();
            assert_eq!(key(Vec3::ONE, tilted, 1.0).facing(), Some(axis), "{axis}");
        }
        let fog = CellKey::fine(&LightSampleContext::medium(Vec3::ONE), 1.0);
        assert_eq!(fog.facing(), None, "fog");
        assert_eq!(fog.coarse().facing(), None, "coarse fog");
    }

    #[test]
    fn neighbours_lie_behind_the_nearest_walls() {
        for i in 0..1000u16 {
            let t = f32::from(i);
            let p = Vec3::new(t * 0.37 - 70.0, t * 7.0 % 5.0 - 2.0, t * 3.1 % 11.0 - 6.0);
            let ctx = LightSampleContext::surface(p, Vec3::Y, Vec3::Y);
            let own = CellKey::fine(&ctx, 1.0);
            let distance = |key: CellKey| {
                let bounds = key.bounds();
                let beyond = (bounds.min - p).max(p - bounds.max);
                beyond.max_element()
            };
            let near = CellKey::nearest_neighbours(&ctx, 1.0);
            let distances = near.map(distance);
            assert!(distances.is_sorted(), "{p}: {distances:?}");
            for key in near {
                let steps = [0, 1, 2].map(|axis| key.at[axis].abs_diff(own.at[axis]));
                assert_eq!(steps.iter().sum::<u32>(), 1, "{p}: shares a wall");
                assert!(distance(key) <= 0.0626, "{p}: within half of a cell");
                assert_eq!(key.facing(), own.facing(), "{p}: faces the same side");
            }
        }
    }

    #[test]
    fn sizes_are_the_nearest_powers_of_two() {
        for (size, nearest) in [(1.0, 1.0), (1.4, 1.0), (1.42, 2.0), (0.72, 1.0), (0.7, 0.5)] {
            assert_eq!(
                key(Vec3::ONE, Vec3::X, size).coarse().size(),
                nearest,
                "{size}"
            );
        }
    }

    #[test]
    fn any_input_has_a_cell() {
        let ends = [f32::MAX, f32::MIN, f32::INFINITY, f32::NAN, 1e-40];
        for x in ends {
            for size in [0.0, -1.0, 1e-40, 1e-30, 1.0, 1e30, f32::INFINITY, f32::NAN] {
                let cell = key(Vec3::new(x, 1.0, -x), Vec3::X, size);
                assert!(
                    cell.size() > 0.0 && cell.coarse().size() > 0.0,
                    "{x}, {size}"
                );
                let again = key(Vec3::new(x, 1.0, -x), Vec3::X, size);
                assert_eq!(again.seed(), cell.seed(), "{x}, {size}");
            }
        }
        let sizes = [0.0, -0.0, -3.0, f32::NAN].map(|size| key(Vec3::ONE, Vec3::X, size).size());
        assert_eq!(sizes, [sizes[0]; 4], "no size is the least");
    }

    /// The same whole numbers everywhere: a change moves every cell, and is value-breaking.
    #[test]
    fn keys_are_pinned() {
        let fine = key(Vec3::new(3.2, -7.9, 0.0), Vec3::new(0.0, -0.8, 0.6), 0.5);
        assert_eq!(fine.at, [52, -124, 4], "where");
        assert_eq!(fine.kind, 127 << 8 | 3 << 1, "of which kind");
        assert_eq!(fine.coarse().at, [6, -16, 0], "rounded down");
        assert_eq!(fine.seed(), 0xe1b6_a53e_7275_947c, "its seed");
    }
}
