use light_math::fraction;
use light_math::glam::Vec2;

/// The `i`th random number, a fraction of 2^64, by integers alone.
///
/// # Source
/// The finaliser of MurmurHash3, with shifts by a whole word, which 32-bit processors have for free.
#[inline(never)]
pub(crate) fn random(i: u32) -> u64 {
    let mut z = u64::from(i)
        .wrapping_add(1)
        .wrapping_mul(0x9e37_79b9_7f4a_7c15);
    for _ in 0..2 {
        z = (z ^ (z >> 32)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    }
    z ^ (z >> 32)
}

/// The `i`th random point of the unit square.
pub(crate) fn random_point(i: u32) -> Vec2 {
    let u = random(i);
    Vec2::new(fraction::to_f32(u), fraction::to_f32(u << 32))
}
