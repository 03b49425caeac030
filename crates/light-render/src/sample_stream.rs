use lights::glam::Vec2;
use lights::math::fraction;

use crate::{FlightNumbers, sobol};

/// The random numbers of one sample of one pixel: Owen-scrambled Sobol points, padded four
/// dimensions at a time.
///
/// A pure function of seed, pixel and sample number: the same numbers on every thread and in any
/// order of calls.
///
/// # Source
/// `[Burley2020]`, section 5 (padding by seed).
#[derive(Clone, Copy, Debug)]
pub struct SampleStream {
    index: u32,
    seed: u32,
}

/// The numbers for the camera ray, each in `[0, 1)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraNumbers {
    /// Where in the pixel.
    pub film: Vec2,
    /// Where on the lens.
    pub lens: Vec2,
}

/// The numbers for one vertex of a path, in `[0, 1)` if nothing else is said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexNumbers {
    /// Which light: a fraction of 2^64.
    pub light: u64,
    /// Which of two lights is looked at for its shadow: a fraction of 2^64.
    pub shadow: u64,
    /// Whether the path goes on.
    pub roulette: f32,
    /// Which lobe of the material.
    pub lobe: f32,
    /// Which direction of the lobe.
    pub direction: Vec2,
}

impl VertexNumbers {
    /// Whether light sample `i` takes the place of those before it as the one that is looked at for
    /// its shadow: a fraction of 2^64, independent for each sample. The first takes none, the
    /// second one that is stratified over the samples of the pixel.
    #[inline]
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "splits a word")]
    pub(crate) const fn shadow_of(&self, i: u32) -> u64 {
        if i < 2 {
            return self.shadow;
        }
        let [high, low] = [(self.shadow >> 32) as u32, self.shadow as u32];
        let high = sobol::hash(high ^ sobol::hash(i));
        fraction::from_words(high, sobol::hash(low ^ high))
    }
}

impl SampleStream {
    /// The numbers of sample `sample` of pixel `(x, y)` in the picture rendered with `seed`.
    #[must_use]
    pub fn new(seed: u32, (x, y): (u32, u32), sample: u32) -> Self {
        let pixel = sobol::hash(sobol::hash(seed) ^ x);
        Self {
            index: sample,
            seed: sobol::hash(pixel.rotate_left(16) ^ y),
        }
    }

    /// The numbers for the camera ray.
    #[must_use]
    pub fn camera(&self) -> CameraNumbers {
        let [a, b, c, d] = self.set(0).map(unit);
        CameraNumbers {
            film: Vec2::new(a, b),
            lens: Vec2::new(c, d),
        }
    }

    /// The numbers for vertex `vertex` of the path, counted from 0.
    #[inline]
    #[must_use]
    pub fn vertex(&self, vertex: u32) -> VertexNumbers {
        let [light, _, _, roulette] = self.set(2 * vertex + 1);
        let [u, v, lobe, shadow] = self.set(2 * vertex + 2);
        let low = sobol::hash(self.key() ^ vertex);
        VertexNumbers {
            light: fraction::from_words(light, low),
            shadow: fraction::from_words(shadow, sobol::hash(low)),
            roulette: unit(roulette),
            lobe: unit(lobe),
            direction: Vec2::new(unit(u), unit(v)),
        }
    }

    /// Where on the `i`th of `count` lights that are chosen at vertex `vertex`, in `[0, 1)^2`:
    /// stratified over all lights that all samples of the pixel choose there.
    #[inline]
    #[must_use]
    pub fn light_point(&self, vertex: u32, i: u32, count: u32) -> Vec2 {
        let index = self.index.wrapping_mul(count).wrapping_add(i);
        let [_, x, y, _] = Self { index, ..*self }.set(2 * vertex + 1);
        Vec2::new(unit(x), unit(y))
    }

    /// The numbers for the way through media to vertex `vertex`, and from there to a light.
    #[inline]
    #[must_use]
    pub(crate) fn flight(&self, vertex: u32) -> FlightNumbers {
        // Far from the sets of all vertices.
        let [first, ..] = self.set(vertex | 1 << 31);
        let path = sobol::hash(self.index ^ sobol::hash(vertex));
        FlightNumbers::new(unit(first), u64::from(self.seed) << 32 | u64::from(path))
    }

    /// A number of its own for every sample of every pixel, for whoever draws from it.
    #[inline]
    #[must_use]
    pub const fn key(&self) -> u32 {
        sobol::hash(self.seed ^ sobol::hash(self.index))
    }

    /// Four numbers that are stratified together over the samples of the pixel, and independent of
    /// every other set.
    #[inline]
    fn set(&self, set: u32) -> [u32; 4] {
        sobol::point(self.index, sobol::hash(self.seed ^ set))
    }
}

/// The number over 2^32, cut to what fits into an `f32`.
#[inline]
fn unit(x: u32) -> f32 {
    (x >> 8) as f32 / (1u32 << 24) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_depend_on_every_key() {
        let of = |seed, pixel, sample| SampleStream::new(seed, pixel, sample).vertex(0);
        let base = of(1, (2, 3), 4);
        assert_eq!(base, of(1, (2, 3), 4), "the same again");
        let others = [
            of(2, (2, 3), 4),
            of(1, (3, 2), 4),
            of(1, (2, 4), 4),
            of(1, (2, 3), 5),
            of(1, (2, 3), 4 + (1 << 16)),
            SampleStream::new(1, (2, 3), 4).vertex(1),
        ];
        for other in others {
            assert_ne!(base, other, "a different key, different numbers");
        }
    }

    #[test]
    fn sixteen_samples_fall_into_sixteen_strata() {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the number of a cell"
        )]
        let cell = |x: f32, n: f32| (x * n) as usize;
        for pixel in 0..8 {
            let mut light = [0; 16];
            let mut cells = [[0; 4]; 4];
            for sample in 0..16 {
                let v = SampleStream::new(7, (pixel, 0), sample).vertex(2);
                light[(v.light >> 60) as usize] += 1;
                let [x, y] = v.direction.to_array();
                cells[cell(x, 4.0)][cell(y, 4.0)] += 1;
            }
            assert_eq!(light, [1; 16], "one light choice a stratum");
            assert_eq!(cells, [[1; 4]; 4], "one direction a cell");
        }
    }
}
