use light_math::fraction;

/// Points of a Latin hypercube: `n` points in `[0, 1)^D`, one in each of the `n` slabs of every
/// axis.
///
/// A point is computed from its number, so nothing is stored. The same seed gives the same points.
///
/// # Source
/// The permutation by hashing is that of `[Kensler2013]`, section 3, with its final rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LatinHypercube {
    n: u32,
    seed: u32,
}

impl LatinHypercube {
    /// The hypercube of `n` points; with `n` = 0 it behaves as with 1.
    #[must_use]
    pub fn new(n: u32, seed: u32) -> Self {
        Self { n: n.max(1), seed }
    }

    /// The number of points.
    #[must_use]
    pub const fn len(&self) -> u32 {
        self.n
    }

    /// Always false: there is at least one point.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        false
    }

    /// Point `index` (taken modulo `n`), each coordinate a [fraction] of 2^64: 32 random bits below
    /// the width of a slab, enough to address every light of a large set.
    #[must_use]
    pub fn point<const D: usize>(&self, index: u32) -> [u64; D] {
        let index = index % self.n;
        let mut axis = 0u32;
        [(); D].map(|()| {
            axis += 1;
            let key = hash(self.seed ^ hash(axis));
            let slab = permute(index, self.n, key);
            let jitter = fraction::from_words(hash(hash(key) ^ index), 1 << 31);
            fraction::stratum(slab, self.n, jitter)
        })
    }

    /// The same point in single precision, still below 1.
    #[must_use]
    pub fn point_f32<const D: usize>(&self, index: u32) -> [f32; D] {
        self.point(index).map(fraction::to_f32)
    }
}

/// A permutation of `0..n` chosen by `key`, evaluated at `i < n`: rounds of invertible steps on the
/// next power of two, repeated until the value falls below `n`.
#[expect(clippy::cast_possible_truncation, reason = "a remainder below n")]
fn permute(i: u32, n: u32, key: u32) -> u32 {
    // Of the bits that the largest number has; none for n = 1.
    let mask = u32::MAX.checked_shr((n - 1).leading_zeros()).unwrap_or(0);
    let half_width = (mask.count_ones() / 2).max(1);
    let mut x = i;
    loop {
        let mut round = key;
        for _ in 0..3 {
            // Adding, multiplying by an odd number and xor with a shifted copy are each one to one
            // below the mask.
            x = x.wrapping_add(round) & mask;
            x = x.wrapping_mul(round | 1) & mask;
            x ^= x >> half_width;
            round = hash(round);
        }
        if x < n {
            break;
        }
    }
    // A few rounds on few bits favour some positions; a random rotation makes all of them equally
    // likely.
    let turn = (u64::from(hash(!key)) * u64::from(n)) >> 32;
    ((u64::from(x) + turn) % u64::from(n)) as u32
}

/// Mixes 32 bits so that each input bit moves half of the output bits.
fn hash(x: u32) -> u32 {
    let x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    let x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    #[test]
    fn every_slab_of_every_axis_holds_one_point() {
        for n in [1, 2, 3, 7, 64, 100, 1023] {
            let cube = LatinHypercube::new(n, 17);
            let mut seen = [[false; 1023]; 3];
            for i in 0..n {
                for (axis, x) in cube.point::<3>(i).into_iter().enumerate() {
                    let (slab, _) = fraction::choose(n, x);
                    let slab = slab as usize;
                    assert!(
                        !core::mem::replace(&mut seen[axis][slab], true),
                        "slab {slab} of {n} is hit twice"
                    );
                }
            }
        }
    }

    #[test]
    fn axes_and_seeds_differ() {
        let points: [[u64; 2]; 2] = [1, 2].map(|seed| LatinHypercube::new(16, seed).point(5));
        assert_ne!(points[0], points[1], "seeds");
        assert_ne!(points[0][0], points[0][1], "axes");
    }

    #[test]
    fn each_bit_of_a_key_moves_half_of_the_bits_of_its_hash() {
        const KEYS: u32 = 1 << 12;
        let mut rng = light_testkit::Rng::new(19);
        let keys: Vec<u32> = (0..KEYS).map(|_| rng.u32()).collect();
        for bit in 0..32 {
            let mut moved = [0u32; 32];
            for &key in &keys {
                let change = hash(key) ^ hash(key ^ (1 << bit));
                (0..32).for_each(|to| moved[to] += change >> to & 1);
            }
            for (to, moved) in moved.into_iter().enumerate() {
                let share = f64::from(moved) / f64::from(KEYS);
                assert!((share - 0.5).abs() < 0.05, "{bit} moves {to}: {share}");
            }
        }
    }

    /// Hashes of different numbers differ: no two points have the same offset in their slabs.
    #[test]
    fn each_point_has_a_place_of_its_own_in_its_slab() {
        for seed in 0..16 {
            let cube = LatinHypercube::new(64, seed);
            let mut places: Vec<u64> = (0..64).map(|i| cube.point::<1>(i)[0] << 6).collect();
            places.sort_unstable();
            places.dedup();
            assert_eq!(places.len(), 64, "seed {seed}");
        }
    }

    /// Above 2^31 there is no next power of two.
    #[test]
    fn the_largest_cubes_have_points() {
        for n in [1 << 31, (1 << 31) + 1, u32::MAX] {
            let cube = LatinHypercube::new(n, 17);
            assert_ne!(cube.point::<2>(0), cube.point::<2>(n - 1), "{n}");
        }
    }

    #[test]
    fn none_is_treated_as_one() {
        assert_eq!(LatinHypercube::new(0, 3).len(), 1, "never empty");
    }

    #[test]
    fn indices_wrap_and_floats_stay_below_one() {
        let cube = LatinHypercube::new(7, 5);
        assert_eq!(cube.point::<2>(3), cube.point::<2>(10), "modulo the number");
        assert_ne!(cube.point::<2>(3), cube.point::<2>(4), "others differ");
        assert!(!cube.is_empty(), "never");
    }

    /// Over many seeds each point is uniform in `[0, 1)^3`, whatever its number: choices that
    /// depend on the number would be biased otherwise.
    #[test]
    fn every_point_is_uniform_over_seeds() {
        use light_testkit::{Rng, chi_squared, kolmogorov_smirnov_uniform};
        const SEEDS: u32 = 1 << 13;
        for n in [1, 2, 3, 4, 5, 8, 16, 31] {
            for index in [0, 1, n / 2, n - 1] {
                let mut rng = Rng::new(u64::from(n));
                let points: Vec<[f64; 3]> = (0..SEEDS)
                    .map(|_| {
                        LatinHypercube::new(n, rng.u32())
                            .point(index)
                            .map(fraction::to_f64)
                    })
                    .collect();
                for axis in 0..3 {
                    let mut places: Vec<f64> = points.iter().map(|p| p[axis]).collect();
                    let outcome = kolmogorov_smirnov_uniform(&mut places);
                    assert!(
                        outcome.passes(),
                        "point {index} of {n}, axis {axis}: {outcome:?}"
                    );
                    let mut pairs = [0u64; 64];
                    for p in &points {
                        let [x, y] = [p[axis], p[(axis + 1) % 3]].map(|x| (x * 8.0) as usize);
                        pairs[y * 8 + x] += 1;
                    }
                    let outcome = chi_squared(&pairs, &[f64::from(SEEDS) / 64.0; 64]);
                    assert!(
                        outcome.passes(),
                        "point {index} of {n}, axes {axis}: {outcome:?}"
                    );
                }
            }
        }
    }
}
