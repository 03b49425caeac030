use lights::glam::Vec3;

use crate::ExactSum;

/// The picture while it is made: the sum of the samples of every pixel, rows from the top.
///
/// The pixel filter is a box one pixel wide: a sample counts for the pixel it falls into and for no other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Film {
    width: u32,
    height: u32,
    samples: u32,
    sums: Vec<ExactSum>,
}

impl Film {
    /// A black film of `width` by `height` pixels.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        let sums = vec![ExactSum::default(); width as usize * height as usize];
        Self {
            width,
            height,
            samples: 0,
            sums,
        }
    }

    /// The film with the given sums, row by row, of `samples` samples a pixel; `None` when the sums do not fit the size.
    #[must_use]
    pub fn from_sums(
        (width, height): (u32, u32),
        samples: u32,
        sums: Vec<ExactSum>,
    ) -> Option<Self> {
        (sums.len() == width as usize * height as usize).then_some(Self {
            width,
            height,
            samples,
            sums,
        })
    }

    /// Width and height in pixels.
    #[must_use]
    pub const fn resolution(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// How many samples every pixel has received.
    #[must_use]
    pub const fn samples(&self) -> u32 {
        self.samples
    }

    /// The sums of all pixels, row by row.
    #[must_use]
    pub fn sums(&self) -> &[ExactSum] {
        &self.sums
    }

    /// The sums of all pixels, row by row, for a pass that adds `samples` samples to each.
    pub fn expose(&mut self, samples: u32) -> &mut [ExactSum] {
        self.samples += samples;
        &mut self.sums
    }

    /// Adds the samples of a film of the same size.
    ///
    /// # Panics
    /// Panics if `other` has another size.
    pub fn add(&mut self, other: &Self) {
        assert_eq!(
            self.resolution(),
            other.resolution(),
            "films of one picture"
        );
        self.samples += other.samples;
        for (sum, &more) in self.sums.iter_mut().zip(&other.sums) {
            *sum = *sum + more;
        }
    }

    /// The mean of each pixel's samples as linear RGB, row by row; black without samples.
    #[must_use]
    pub fn develop(&self) -> Vec<Vec3> {
        self.sums.iter().map(|sum| sum.mean(self.samples)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_means() {
        let mut film = Film::new(2, 1);
        assert_eq!(
            film.develop(),
            [Vec3::ZERO; 2],
            "black before the first sample"
        );
        film.expose(1)[1] += Vec3::splat(1.0);
        film.expose(1)[1] += Vec3::splat(3.0);
        assert_eq!(
            film.develop(),
            [Vec3::ZERO, Vec3::splat(2.0)],
            "the mean of 1 and 3"
        );
        assert_eq!((film.samples(), film.resolution()), (2, (2, 1)), "counts");
    }
}
