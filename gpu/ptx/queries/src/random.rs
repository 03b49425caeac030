/// A row of random numbers, by integers alone.
///
/// # Source
/// SplitMix64.
#[derive(Clone, Copy, Debug)]
pub struct Random(pub u64);

impl Random {
    /// The next 64 bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// The next number in [0, 1).
    pub const fn unit(&mut self) -> f32 {
        light_math::fraction::to_f32(self.bits())
    }

    /// The next number in [-1, 1).
    pub const fn signed(&mut self) -> f32 {
        2.0 * self.unit() - 1.0
    }
}
