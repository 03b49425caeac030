//! Random numbers of a cell: hashes of its key.

/// A permutation of all words: each bit changes about half of the others.
///
/// # Source
/// `[Steele2014]`, figure 16: variant 13 of Stafford's mixers.
#[inline]
pub(super) const fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_bit_moves_half_of_the_bits() {
        for bit in 0..64 {
            let changed: u32 = (0..1000u64)
                .map(|x| (mix(x) ^ mix(x ^ 1 << bit)).count_ones())
                .sum();
            let mean = f64::from(changed) / 1000.0;
            assert!((mean - 32.0).abs() < 1.0, "bit {bit}: {mean}");
        }
    }
}
