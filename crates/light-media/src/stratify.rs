/// Points of a Latin hypercube: `n` points in `[0, 1)^D`, one in each of the `n` slabs of every axis.
///
/// A point is computed from its number, so nothing is stored. The same seed gives the same points.
///
/// # Source
/// The permutation by hashing is that of `[Kensler2013]`, section 3.
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

    /// How many points it has.
    #[must_use]
    pub const fn len(&self) -> u32 {
        self.n
    }

    /// Never true: there is always a point.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        false
    }

    /// Point `index` (taken modulo `n`), to 32 bits below the width of a slab: enough to address every light of a large
    /// set.
    #[must_use]
    pub fn point<const D: usize>(&self, index: u32) -> [f64; D] {
        let index = index % self.n;
        let mut axis = 0u32;
        [(); D].map(|()| {
            axis += 1;
            let key = hash(self.seed ^ hash(axis));
            let slab = permute(index, self.n, key);
            let jitter = (f64::from(hash(key ^ index)) + 0.5) / 4_294_967_296.0;
            (f64::from(slab) + jitter) / f64::from(self.n)
        })
    }

    /// The same point in single precision, still below 1.
    #[must_use]
    pub fn point_f32<const D: usize>(&self, index: u32) -> [f32; D] {
        self.point(index).map(narrow)
    }
}

/// A number of `[0, 1)` in single precision, still below 1.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounds to single precision"
)]
pub(crate) fn narrow(u: f64) -> f32 {
    (u as f32).min(light_math::float::ONE_MINUS_EPSILON)
}

/// A permutation of `0..n` chosen by `key`, evaluated at `i < n`: rounds of invertible steps on the next power of two,
/// repeated until the value falls below `n`.
fn permute(i: u32, n: u32, key: u32) -> u32 {
    let mask = n.next_power_of_two().wrapping_sub(1);
    let half_width = (mask.count_ones() / 2).max(1);
    let mut x = i;
    loop {
        let mut round = key;
        for _ in 0..3 {
            // Adding, multiplying by an odd number and xor with a shifted copy are each one to one below the mask.
            x = x.wrapping_add(round) & mask;
            x = x.wrapping_mul(round | 1) & mask;
            x ^= x >> half_width;
            round = hash(round);
        }
        if x < n {
            return x;
        }
    }
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

    #[test]
    fn every_slab_of_every_axis_holds_one_point() {
        for n in [1, 2, 3, 7, 64, 100, 1023] {
            let cube = LatinHypercube::new(n, 17);
            let mut seen = [[false; 1023]; 3];
            for i in 0..n {
                for (axis, x) in cube.point::<3>(i).into_iter().enumerate() {
                    assert!((0.0..1.0).contains(&x), "{x} lies in [0, 1)");
                    let slab = (x * f64::from(n)) as usize;
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
        let points: [[f64; 2]; 2] = [1, 2].map(|seed| LatinHypercube::new(16, seed).point(5));
        assert_ne!(points[0], points[1], "seeds");
        assert_ne!(points[0][0], points[0][1], "axes");
    }

    #[test]
    fn none_is_treated_as_one() {
        assert_eq!(LatinHypercube::new(0, 3).len(), 1, "never empty");
    }
}
