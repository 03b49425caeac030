use light_math::fraction;
use light_math::glam::Vec2;

/// The `i`th random number, a fraction of 2^64, by integers alone.
///
/// # Source
/// The finaliser of SplitMix64.
pub(crate) fn random(i: u32) -> u64 {
    let z = u64::from(i)
        .wrapping_add(1)
        .wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The `i`th random point of the unit square.
pub(crate) fn random_point(i: u32) -> Vec2 {
    let u = random(i);
    Vec2::new(fraction::to_f32(u), fraction::to_f32(u << 32))
}
