use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Random choices of a generated scene: the same numbers from the same seed.
#[derive(Clone, Debug)]
pub(super) struct Dice(Pcg64Mcg);

impl Dice {
    pub(super) fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// A number in `[0, 1)`.
    pub(super) fn unit(&mut self) -> f32 {
        // 24 bits fill the mantissa of a number below 1.
        (self.0.next_u32() >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// A number in `[low, high)`.
    pub(super) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// Whether something of probability `p` happens.
    pub(super) fn chance(&mut self, p: f32) -> bool {
        self.unit() < p
    }

    /// One of the values; there must be at least one.
    pub(super) fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())]
    }

    /// A whole number below `end`, which is at least 1 and not above a million.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and the end"
    )]
    pub(super) fn below(&mut self, end: usize) -> usize {
        let index = (self.unit() * end as f32) as usize;
        index.min(end - 1)
    }
}
