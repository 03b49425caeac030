use light_math::glam::{Vec2, Vec3};
use rand_core::{Rng as _, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// The random numbers of all tests: seeded, the same on every machine.
#[derive(Clone, Debug)]
pub struct Rng(Pcg64Mcg);

impl Rng {
    /// The sequence number `seed`.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// 32 random bits.
    pub fn u32(&mut self) -> u32 {
        self.0.next_u32()
    }

    /// 64 random bits: a fraction of 2^64.
    pub fn u64(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// A multiple of 2^-24 in `[0, 1)`.
    pub fn f32(&mut self) -> f32 {
        (self.u32() >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// A multiple of 2^-53 in `[0, 1)`.
    pub fn f64(&mut self) -> f64 {
        (self.u64() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// A number in `[low, high)`.
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.f32()
    }

    /// A number in `[low, high)` whose logarithm is uniform; `low > 0`.
    pub fn log_range(&mut self, low: f32, high: f32) -> f32 {
        low * (high / low).powf(self.f32())
    }

    /// An index below `n`, which is positive; each as likely, to 2^-53.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.f64() * n as f64) as usize).min(n - 1)
    }

    /// A point of the unit square, each coordinate as [`f32`](Self::f32).
    pub fn vec2(&mut self) -> Vec2 {
        Vec2::new(self.f32(), self.f32())
    }

    /// A point of the unit cube, each coordinate as [`f32`](Self::f32).
    pub fn vec3(&mut self) -> Vec3 {
        Vec3::new(self.f32(), self.f32(), self.f32())
    }

    /// A unit vector, uniform over the sphere.
    pub fn direction(&mut self) -> Vec3 {
        let z = 1.0 - 2.0 * self.f64();
        let r = (1.0 - z * z).max(0.0).sqrt();
        let (s, c) = (self.f64() * core::f64::consts::TAU).sin_cos();
        Vec3::new((r * c) as f32, (r * s) as f32, z as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sequences_repeat_and_differ() {
        assert_eq!(Rng::new(1).u32(), Rng::new(1).u32(), "same seed");
        assert_ne!(Rng::new(1).u32(), Rng::new(2).u32(), "other seed");
    }

    #[test]
    fn numbers_stay_in_their_ranges() {
        let mut rng = Rng::new(3);
        for _ in 0..10_000 {
            assert!((0.0..1.0).contains(&rng.f32()), "f32");
            assert!((0.0..1.0).contains(&rng.f64()), "f64");
            assert!(rng.below(3) < 3, "index");
            assert!(rng.direction().is_normalized(), "unit length");
        }
    }
}
