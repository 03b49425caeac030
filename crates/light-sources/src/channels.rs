use crate::glam::Vec3;

/// The channels of a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Channels {
    /// One grey value.
    Gray,
    /// Red, green, blue.
    Rgb,
}

impl Channels {
    /// The number of values per texel.
    #[must_use]
    pub const fn count(self) -> usize {
        match self {
            Self::Gray => 1,
            Self::Rgb => 3,
        }
    }

    /// The colour of texel `index` in a list of numbers.
    #[inline]
    pub(crate) fn color(self, index: usize, number: impl Fn(usize) -> f32) -> Vec3 {
        match self {
            Self::Gray => Vec3::splat(number(index)),
            Self::Rgb => {
                let i = 3 * index;
                Vec3::new(number(i), number(i + 1), number(i + 2))
            }
        }
    }

    /// Calls `each` with the colour of every texel of an interleaved list, read by `number`.
    #[inline]
    pub(crate) fn for_each<T>(
        self,
        numbers: &[T],
        number: impl Fn(&T) -> f32,
        mut each: impl FnMut(Vec3),
    ) {
        match self {
            Self::Gray => numbers.iter().for_each(|x| each(Vec3::splat(number(x)))),
            Self::Rgb => numbers.chunks_exact(3).for_each(|rgb| {
                each(Vec3::new(number(&rgb[0]), number(&rgb[1]), number(&rgb[2])));
            }),
        }
    }
}
