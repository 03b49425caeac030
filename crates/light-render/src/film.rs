use lights::glam::{DVec3, Vec3};

/// The picture while it is made: the sum of the samples of every pixel, rows from the top.
///
/// The pixel filter is a box one pixel wide: a sample counts for the pixel it falls into and for no other. Sums are
/// kept in f64, so that a picture of many samples is not limited by rounding.
#[derive(Clone, Debug)]
pub struct Film {
    width: u32,
    height: u32,
    samples: u32,
    sums: Vec<DVec3>,
}

impl Film {
    /// A black film of `width` by `height` pixels.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            samples: 0,
            sums: vec![DVec3::ZERO; width as usize * height as usize],
        }
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

    /// The sums of all pixels, row by row: what one pass of `samples` further samples a pixel adds to.
    pub fn expose(&mut self, samples: u32) -> &mut [DVec3] {
        self.samples += samples;
        &mut self.sums
    }

    /// The mean of each pixel's samples as linear RGB, row by row; black without samples.
    #[must_use]
    pub fn develop(&self) -> Vec<Vec3> {
        let scale = 1.0 / f64::from(self.samples.max(1));
        self.sums
            .iter()
            .map(|&sum| (sum * scale).as_vec3())
            .collect()
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
        film.expose(1)[1] += DVec3::splat(1.0);
        film.expose(1)[1] += DVec3::splat(3.0);
        assert_eq!(
            film.develop(),
            [Vec3::ZERO, Vec3::splat(2.0)],
            "the mean of 1 and 3"
        );
        assert_eq!((film.samples(), film.resolution()), (2, (2, 1)), "counts");
    }
}
