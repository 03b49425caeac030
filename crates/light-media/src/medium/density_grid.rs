use super::majorant_grid::MajorantGrid;
use light_math::glam::Vec3;

/// Samples of a quantity on a regular grid over the unit cube, interpolated linearly, zero outside.
///
/// Sample `(x, y, z)` stands at `((x, y, z) + 1/2) / size`; x runs fastest. The values may live anywhere: in a vector, a
/// borrowed slice, in flash. Costs 4 bytes a sample and 16 KiB for the maxima of coarse cells.
#[derive(Clone, Debug)]
pub struct DensityGrid<S> {
    size: [u32; 3],
    values: S,
    majorants: MajorantGrid,
}

/// Why a grid is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DensityGridError {
    /// The size is zero on some axis.
    Empty,
    /// The number of values is not the product of the three sizes.
    Length,
    /// A value is negative or not finite.
    Value {
        /// Where it stands.
        index: usize,
    },
}

impl<S: AsRef<[f32]>> DensityGrid<S> {
    /// The grid of `size[0] * size[1] * size[2]` values.
    ///
    /// # Errors
    /// A size is zero, the number of values does not fit the sizes, or a value is negative or not finite.
    pub fn new(size: [u32; 3], values: S) -> Result<Self, DensityGridError> {
        if size.contains(&0) {
            return Err(DensityGridError::Empty);
        }
        let expected = size
            .iter()
            .try_fold(1usize, |n, &s| n.checked_mul(s as usize));
        let samples = values.as_ref();
        if expected != Some(samples.len()) {
            return Err(DensityGridError::Length);
        }
        if let Some(index) = samples.iter().position(|v| !(*v >= 0.0 && v.is_finite())) {
            return Err(DensityGridError::Value { index });
        }
        let majorants = MajorantGrid::new(size, samples);
        Ok(Self {
            size,
            values,
            majorants,
        })
    }

    /// The value at `p` of the unit cube, trilinearly interpolated.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "far outside the cast saturates, where all samples are zero"
    )]
    pub fn lookup(&self, p: Vec3) -> f32 {
        let at = p * Vec3::from(self.size.map(|n| n as f32)) - 0.5;
        let base = at.floor();
        let f = at - base;
        let base = base.to_array().map(|x| x as i32);
        let mut sum = 0.0;
        for corner in 0..8 {
            let offset = [corner & 1, corner >> 1 & 1, corner >> 2];
            let weight = (0..3)
                .map(|axis| {
                    if offset[axis] == 1 {
                        f[axis]
                    } else {
                        1.0 - f[axis]
                    }
                })
                .product::<f32>();
            sum += weight
                * self.sample([0, 1, 2].map(|axis: usize| base[axis].saturating_add(offset[axis])));
        }
        sum
    }

    /// The maxima of coarse cells.
    #[must_use]
    pub(super) const fn majorants(&self) -> &MajorantGrid {
        &self.majorants
    }

    fn sample(&self, [x, y, z]: [i32; 3]) -> f32 {
        let [nx, ny, nz] = self.size.map(|n| n as usize);
        let inside = |i: i32, n: usize| usize::try_from(i).ok().filter(|i| *i < n);
        let (Some(x), Some(y), Some(z)) = (inside(x, nx), inside(y, ny), inside(z, nz)) else {
            return 0.0;
        };
        self.values.as_ref()[(z * ny + y) * nx + x]
    }
}

impl core::fmt::Display for DensityGridError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Empty => f.write_str("a grid needs at least one sample on each axis"),
            Self::Length => {
                f.write_str("the number of grid values is not the product of the grid's sizes")
            }
            Self::Value { index } => write!(f, "grid value {index} is negative or not finite"),
        }
    }
}

impl core::error::Error for DensityGridError {}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    fn ramp(size: [u32; 3]) -> DensityGrid<Vec<f32>> {
        let n: u32 = size.iter().product();
        DensityGrid::new(size, (0..n).map(|i| ((i * 7919) % 101) as f32).collect()).expect("valid")
    }

    #[test]
    fn samples_are_met_at_their_centres_and_fade_to_zero_outside() {
        let grid = ramp([3, 4, 5]);
        let centre = (Vec3::new(2.0, 1.0, 3.0) + 0.5) / Vec3::new(3.0, 4.0, 5.0);
        let expected = grid.values[(3 * 4 + 1) * 3 + 2];
        assert!(
            (grid.lookup(centre) - expected).abs() < 1e-3,
            "sample (2, 1, 3)"
        );
        assert_eq!(grid.lookup(Vec3::splat(2.0)), 0.0, "outside");
        assert_eq!(grid.lookup(Vec3::splat(-1e30)), 0.0, "far outside");
    }

    #[test]
    fn coarse_maxima_bound_every_lookup() {
        for size in [[1, 1, 1], [2, 5, 3], [40, 16, 33]] {
            let grid = ramp(size);
            for i in 0..20_000u32 {
                // A low-discrepancy walk through the cube.
                let p = (Vec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5) * i as f32).fract();
                let cell = (p * MajorantGrid::CELLS as f32)
                    .to_array()
                    .map(|x| x as i32);
                assert!(
                    grid.lookup(p) <= grid.majorants().get(cell) * 1.000_01,
                    "size {size:?}, p {p}"
                );
            }
        }
    }

    #[test]
    fn nonsense_is_refused() {
        let make = |size, values: &[f32]| DensityGrid::new(size, values).err();
        assert_eq!(make([0, 1, 1], &[]), Some(DensityGridError::Empty), "empty");
        assert_eq!(
            make([2, 1, 1], &[1.0]),
            Some(DensityGridError::Length),
            "length"
        );
        assert_eq!(
            make([2, 1, 1], &[1.0, f32::NAN]),
            Some(DensityGridError::Value { index: 1 }),
            "NaN"
        );
        assert_eq!(
            make([u32::MAX; 3], &[]),
            Some(DensityGridError::Length),
            "overflow"
        );
    }
}
