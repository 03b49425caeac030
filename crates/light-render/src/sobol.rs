//! Sobol's sequence in four dimensions, Owen-scrambled and shuffled by a seed.
//!
//! Whole numbers here are reversed: the lowest bit has the weight 1/2. A scramble is
//! then a hash in which every bit depends on lower bits alone.

/// How many bits of the index count: the sequence repeats after 2^24 points.
const INDEX_BITS: usize = 24;

/// Point number `index` of the sequence that `seed` scrambles and shuffles: four numbers, to be
/// read over 2^32.
///
/// Any power of two of consecutive points, from a multiple of it on, is stratified in every
/// elementary interval; sequences of different seeds are independent.
///
/// # Source
/// `[Burley2020]`, sections 4 and 5; the hash is that of `[Vegdahl2021]`.
#[inline]
#[must_use]
pub(crate) fn point(index: u32, seed: u32) -> [u32; 4] {
    const DIMENSION_KEYS: [u32; 4] = [0x912f_69ba, 0x174f_18ab, 0x691e_72ca, 0xb40c_c1b8];
    let shuffled = scramble(index.reverse_bits(), hash(seed));
    let mut x = [0; 4];
    for (k, table) in TABLES.iter().enumerate() {
        let nibble = (shuffled >> (28 - 4 * k)) & 15;
        for (x, direction) in x.iter_mut().zip(table[nibble as usize]) {
            *x ^= direction;
        }
    }
    for (x, key) in x.iter_mut().zip(DIMENSION_KEYS) {
        *x = scramble(*x, hash(seed ^ key)).reverse_bits();
    }
    x
}

/// A well-mixed function of `n`.
///
/// # Source
/// `[Wellons2018]`, the 32-bit function of lowest bias with two multiplications.
#[inline]
#[must_use]
pub(crate) const fn hash(n: u32) -> u32 {
    // So that 0 does not become 0.
    let mut n = n ^ 0xe6fe_3beb;
    n ^= n >> 16;
    n = n.wrapping_mul(0x7feb_352d);
    n ^= n >> 15;
    n = n.wrapping_mul(0x846c_a68b);
    n ^ (n >> 16)
}

/// A random Owen scramble of the reversed number `n`, chosen by a well-mixed `key`.
#[inline]
const fn scramble(n: u32, key: u32) -> u32 {
    let mut n = n;
    n ^= n.wrapping_mul(0x3d20_adea);
    n = n.wrapping_add(key);
    n = n.wrapping_mul((key >> 16) | 1);
    n ^= n.wrapping_mul(0x0552_6c56);
    n ^ n.wrapping_mul(0x53a2_2864)
}

/// For each four bits of a reversed index, what they contribute to the four reversed numbers.
static TABLES: [[[u32; 4]; 16]; INDEX_BITS / 4] = tables();

const fn tables() -> [[[u32; 4]; 16]; INDEX_BITS / 4] {
    let directions = [
        van_der_corput(),
        directions::<1>(0, [1]),
        directions::<2>(1, [1, 3]),
        directions::<3>(1, [1, 3, 1]),
    ];
    let mut tables = [[[0; 4]; 16]; INDEX_BITS / 4];
    let mut i = 0;
    // One table entry a step: table, nibble, bit of the nibble, dimension.
    while i < INDEX_BITS / 4 * 16 * 4 * 4 {
        let (dimension, bit, nibble, table) = (i % 4, i / 4 % 4, i / 16 % 16, i / 256);
        if nibble >> bit & 1 == 1 {
            let direction: u32 = directions[dimension][4 * table + 3 - bit];
            tables[table][nibble][dimension] ^= direction.reverse_bits();
        }
        i += 1;
    }
    tables
}

/// The direction numbers of the first dimension: the index itself, mirrored at the point.
const fn van_der_corput() -> [u32; 32] {
    let mut v = [0; 32];
    let mut i = 0;
    while i < 32 {
        v[i] = 1 << (31 - i);
        i += 1;
    }
    v
}

/// The direction numbers of a primitive polynomial of degree `S` with inner coefficients `a`, from
/// its first numbers `m`.
///
/// # Source
/// `[JoeKuo2008]`, equations 2 and 3, and table of initial numbers.
const fn directions<const S: usize>(a: u32, m: [u32; S]) -> [u32; 32] {
    let mut v = [0; 32];
    let mut i = 0;
    while i < 32 {
        if i < S {
            v[i] = m[i] << (31 - i);
        } else {
            v[i] = v[i - S] ^ (v[i - S] >> S);
            let mut k = 1;
            while k < S {
                if a >> (S - 1 - k) & 1 == 1 {
                    v[i] ^= v[i - k];
                }
                k += 1;
            }
        }
        i += 1;
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many points fall into each of the `a * b` cells of two dimensions.
    fn cells(points: &[[u32; 4]], (i, a): (usize, u32), (j, b): (usize, u32)) -> Vec<u32> {
        let mut counts = vec![0; (a * b) as usize];
        let cell = |x: u32, n: u32| ((u64::from(x) * u64::from(n)) >> 32) as usize;
        for point in points {
            counts[cell(point[i], a) * b as usize + cell(point[j], b)] += 1;
        }
        counts
    }

    #[test]
    fn points_fill_elementary_intervals_one_by_one() {
        for seed in [0, 1, 0xdead_beef] {
            // Any aligned run counts, not only the first.
            for start in [0, 256, 1 << 20] {
                let points: Vec<_> = (start..start + 256).map(|i| point(i, seed)).collect();
                for (a, b) in [(1, 256), (4, 64), (16, 16), (64, 4), (256, 1)] {
                    let counts = cells(&points, (0, a), (1, b));
                    assert_eq!(counts, vec![1; 256], "seed {seed}, {a} by {b}");
                }
                for dimension in 0..4 {
                    let counts = cells(&points, (dimension, 256), (0, 1));
                    assert_eq!(counts, vec![1; 256], "seed {seed}, dimension {dimension}");
                }
            }
        }
    }

    #[test]
    fn seeds_are_independent() {
        // Points of one index over many seeds are random: about as many in each quarter.
        let points: Vec<_> = (0..4096).map(|seed| point(5, hash(seed))).collect();
        for (i, j) in [(0, 1), (1, 2), (2, 3), (0, 3)] {
            for count in cells(&points, (i, 2), (j, 2)) {
                // Five standard deviations of a binomial with p = 1/4.
                assert!(
                    count.abs_diff(1024) < 140,
                    "{count} in dimensions {i} and {j}"
                );
            }
        }
    }
}
