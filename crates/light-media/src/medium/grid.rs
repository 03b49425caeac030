use light_math::glam::Vec3;

/// Samples of `K` channels on a regular grid over the unit cube, interpolated linearly, zero
/// outside.
///
/// Sample `(x, y, z)` is at `((x, y, z) + 1/2) / size`; x runs fastest, and the channels of a
/// sample are adjacent. The storage is a type parameter: a vector, a borrowed slice, flash.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Grid<S, const K: usize = 1> {
    size: [u32; 3],
    values: S,
}

/// Why a grid is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GridError {
    /// The size is zero on some axis.
    Empty,
    /// The number of values is not the product of the three sizes and the channels.
    Length,
    /// A value is negative or not finite.
    Value {
        /// Index of the value.
        index: usize,
    },
}

impl<S: AsRef<[f32]>, const K: usize> Grid<S, K> {
    /// The grid of `size[0] * size[1] * size[2]` samples, each of `K` values.
    ///
    /// # Errors
    /// A size is zero, the number of values does not fit the sizes, or a value is negative or not
    /// finite.
    pub fn new(size: [u32; 3], values: S) -> Result<Self, GridError> {
        if size.contains(&0) {
            return Err(GridError::Empty);
        }
        let expected = size.iter().try_fold(K, |n, &s| n.checked_mul(s as usize));
        let samples = values.as_ref();
        if expected != Some(samples.len()) {
            return Err(GridError::Length);
        }
        if let Some(index) = samples.iter().position(|v| !(*v >= 0.0 && v.is_finite())) {
            return Err(GridError::Value { index });
        }
        Ok(Self { size, values })
    }

    /// Samples on each axis.
    pub(super) const fn size(&self) -> [u32; 3] {
        self.size
    }

    /// The largest value of each sample, x fastest.
    pub(super) fn maxima(&self) -> impl Iterator<Item = f32> {
        let samples = self.values.as_ref().chunks_exact(K.max(1));
        samples.map(|sample| sample.iter().copied().fold(0.0, f32::max))
    }

    /// The largest value of all.
    #[must_use]
    pub fn max_value(&self) -> f32 {
        self.maxima().fold(0.0, f32::max)
    }

    /// The channels at `p` of the unit cube, trilinearly interpolated.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "far outside the cast saturates, where all samples are zero"
    )]
    pub fn lookup(&self, p: Vec3) -> [f32; K] {
        let at = p * Vec3::from(self.size.map(|n| n as f32)) - 0.5;
        let base = at.floor();
        let f = at - base;
        let base = base.to_array().map(|x| x as i32);
        let mut sum = [0.0; K];
        for corner in 0..8 {
            let offset = [corner & 1, corner >> 1 & 1, corner >> 2];
            let place = [0, 1, 2].map(|axis: usize| base[axis].saturating_add(offset[axis]));
            let Some(sample) = self.sample(place) else {
                continue;
            };
            let weight = (0..3)
                .map(|axis| {
                    if offset[axis] == 1 {
                        f[axis]
                    } else {
                        1.0 - f[axis]
                    }
                })
                .product::<f32>();
            for (sum, value) in sum.iter_mut().zip(sample) {
                *sum += weight * value;
            }
        }
        sum
    }

    fn sample(&self, [x, y, z]: [i32; 3]) -> Option<&[f32]> {
        let [nx, ny, nz] = self.size.map(|n| n as usize);
        let inside = |i: i32, n: usize| usize::try_from(i).ok().filter(|i| *i < n);
        let (x, y, z) = (inside(x, nx)?, inside(y, ny)?, inside(z, nz)?);
        let first = ((z * ny + y) * nx + x) * K;
        self.values.as_ref().get(first..first + K)
    }
}

impl core::fmt::Display for GridError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Empty => f.write_str("a grid needs at least one sample on each axis"),
            Self::Length => f.write_str("the number of grid values does not fit the grid's sizes"),
            Self::Value { index } => write!(f, "grid value {index} is negative or not finite"),
        }
    }
}

impl core::error::Error for GridError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_met_at_their_centres_and_fade_to_zero_outside() {
        let values: [f32; 120] = core::array::from_fn(|i| ((i * 7919) % 101) as f32);
        let grid = Grid::<_, 2>::new([3, 4, 5], &values[..]).expect("valid");
        let centre = (Vec3::new(2.0, 1.0, 3.0) + 0.5) / Vec3::new(3.0, 4.0, 5.0);
        let first = 2 * ((3 * 4 + 1) * 3 + 2);
        for (value, expected) in grid.lookup(centre).into_iter().zip(&values[first..]) {
            assert!((value - expected).abs() < 1e-3, "sample (2, 1, 3)");
        }
        assert_eq!(grid.lookup(Vec3::splat(2.0)), [0.0; 2], "outside");
        assert_eq!(grid.lookup(Vec3::splat(-1e30)), [0.0; 2], "far outside");
        assert_eq!(grid.max_value(), 100.0, "the largest");
    }

    #[test]
    fn nonsense_is_refused() {
        let make = |size, values: &[f32]| Grid::<_, 1>::new(size, values).err();
        assert_eq!(make([0, 1, 1], &[]), Some(GridError::Empty), "empty");
        assert_eq!(make([2, 1, 1], &[1.0]), Some(GridError::Length), "length");
        assert_eq!(
            make([2, 1, 1], &[1.0, f32::NAN]),
            Some(GridError::Value { index: 1 }),
            "NaN"
        );
        assert_eq!(
            make([u32::MAX; 3], &[]),
            Some(GridError::Length),
            "overflow"
        );
        let three = Grid::<_, 3>::new([1, 1, 1], [1.0f32, 2.0]).err();
        assert_eq!(three, Some(GridError::Length), "a channel is missing");
    }
}
