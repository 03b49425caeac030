use lights::glam::Vec3;

use crate::{ExactSum, FilmRow};

/// The film: the sum of the samples of every pixel, rows from the top.
///
/// The pixel filter is a box one pixel wide: a sample counts for the pixel it falls into and for no
/// other. A pixel takes 24, 30 or 48 bytes. A sample of more than 2^46 (7.0e13) counts as that much,
/// and what of it is below 2^-48 (3.6e-15) is lost.
#[derive(Clone, Debug)]
pub struct Film {
    width: u32,
    samples: u32,
    rows: Vec<FilmRow>,
}

impl Film {
    /// Bytes per pixel of rows where a sum of a channel reaches 65536; others take 24, and rows
    /// with sums above 2^31, which no sensible scene has, 48.
    pub(crate) const BYTES_PER_PIXEL: u64 = 30;

    /// A black film of `width` by `height` pixels.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        let row = || FilmRow::new(width as usize);
        Self {
            width,
            samples: 0,
            rows: (0..height).map(|_| row()).collect(),
        }
    }

    /// The film with the given sums, row by row, of `samples` samples a pixel; `None` when the sums
    /// do not fit the size.
    #[must_use]
    pub fn from_sums(
        (width, height): (u32, u32),
        samples: u32,
        sums: impl IntoIterator<Item = ExactSum>,
    ) -> Option<Self> {
        let mut film = Self::new(width, height);
        film.samples = samples;
        let mut sums = sums.into_iter();
        for row in &mut film.rows {
            for x in 0..width as usize {
                row.add_sum(x, sums.next()?);
            }
        }
        sums.next().is_none().then_some(film)
    }

    /// Width and height in pixels.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "made from a u32")]
    pub fn resolution(&self) -> (u32, u32) {
        (self.width, self.rows.len() as u32)
    }

    /// How many samples every pixel has received.
    #[must_use]
    pub const fn samples(&self) -> u32 {
        self.samples
    }

    /// The sums of all pixels, row by row.
    pub fn sums(&self) -> impl Iterator<Item = ExactSum> {
        self.rows.iter().flat_map(FilmRow::sums)
    }

    /// The rows from the top, for a pass that adds `samples` samples to each pixel.
    pub(crate) fn expose(&mut self, samples: u32) -> &mut [FilmRow] {
        self.samples += samples;
        &mut self.rows
    }

    /// Adds the samples of a film of the same size.
    ///
    /// # Panics
    /// Panics if `other` has another size.
    pub fn add(&mut self, other: &Self) {
        self.samples += other.samples;
        self.add_light(other);
    }

    /// Adds the light of a film of the same size whose samples are of the same paths.
    ///
    /// # Panics
    /// Panics if `other` has another size.
    pub(crate) fn add_light(&mut self, other: &Self) {
        assert_eq!(
            self.resolution(),
            other.resolution(),
            "films of one picture"
        );
        for (row, more) in self.rows.iter_mut().zip(&other.rows) {
            for (x, sum) in more.sums().enumerate() {
                row.add_sum(x, sum);
            }
            row.add_clipped(more);
        }
    }

    /// How many pixels have samples that a sum holds only 2^46 of.
    pub(crate) fn clipped_pixels(&self) -> usize {
        self.rows.iter().map(FilmRow::clipped).sum()
    }

    /// The mean of each pixel's samples as linear RGB, row by row; black without samples.
    #[must_use]
    pub fn develop(&self) -> Vec<Vec3> {
        self.sums().map(|sum| sum.mean(self.samples)).collect()
    }
}

impl PartialEq for Film {
    fn eq(&self, other: &Self) -> bool {
        // Rows of equal sums may differ in their storage.
        self.resolution() == other.resolution()
            && self.samples == other.samples
            && self.sums().eq(other.sums())
    }
}

impl Eq for Film {}

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
        film.expose(1)[0].add(1, Vec3::splat(1.0));
        film.expose(1)[0].add(1, Vec3::splat(3.0));
        assert_eq!(
            film.develop(),
            [Vec3::ZERO, Vec3::splat(2.0)],
            "the mean of 1 and 3"
        );
        assert_eq!((film.samples(), film.resolution()), (2, (2, 1)), "counts");
    }

    #[test]
    fn clipped_pixels_are_counted_once() {
        let mut film = Film::new(3, 2);
        film.expose(1)[0].add(1, Vec3::splat(ExactSum::from(Vec3::MAX).mean(1).x));
        assert_eq!(film.clipped_pixels(), 0, "all of the largest term");
        for _ in 0..2 {
            film.expose(1)[1].add(2, Vec3::new(0.0, 8e13, 0.0));
        }
        assert_eq!(film.clipped_pixels(), 1, "two samples of one pixel");
        let mut other = Film::new(3, 2);
        other.expose(1)[0].add(0, Vec3::MAX);
        other.add(&film);
        assert_eq!(other.clipped_pixels(), 2, "one of each");
        other.add(&film);
        assert_eq!(other.clipped_pixels(), 2, "the same ones");
    }

    #[test]
    fn sums_make_a_film_of_their_size_alone() {
        let sums = [1.0, 1e5, 1e12].map(|x| ExactSum::from(Vec3::splat(x)));
        let film = Film::from_sums((3, 1), 2, sums).expect("three pixels");
        assert!(film.sums().eq(sums), "the same sums");
        assert_eq!(Film::from_sums((2, 1), 2, sums), None, "one too many");
        assert_eq!(Film::from_sums((4, 1), 2, sums), None, "one too few");
        let mut dimmed = Film::from_sums((3, 1), 1, sums).expect("three pixels");
        dimmed.expose(1)[0].add(2, Vec3::splat(-1e12));
        let plain = [1.0, 1e5, 0.0].map(|x| ExactSum::from(Vec3::splat(x)));
        let plain = Film::from_sums((3, 1), 2, plain).expect("three pixels");
        assert_eq!(dimmed, plain, "whatever room the rows have");
    }
}
