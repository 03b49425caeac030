use light_math::discrete::{PART, PARTS, parts_scale};
use light_math::fraction::divide;
use light_math::glam::{Vec4, Vec4Swizzles};

use crate::lane_math::{LaneMask, nearest};
use crate::node::wide_node::WIDTH;
use crate::query::weights::{Weights, total};

/// All parts, as a number that lanes can be compared with.
const ALL: f32 = PARTS as f32;

/// How many parts are left over on average.
const LEFT_OVER: f32 = 0.5 * WIDTH as f32;

/// Whether the machine computes several lanes at once, as all with 64-bit addresses do. Without
/// vectors a guess and sums in pairs are slower; the choices are the same.
const HAS_VECTORS: bool = cfg!(target_pointer_width = "64");

/// A child chosen in proportion to its weight.
pub(crate) struct Choice {
    pub(crate) child: usize,
    pub(crate) probability: f32,
    /// The unused part of `u`.
    pub(crate) u: u64,
}

/// Choices by [`discrete`](light_math::discrete)'s rule, for all children of a node together.
impl Weights {
    /// The child that `u` falls on; `None` if no child can contribute.
    // Without an operating system memory for code is short: all queries call one function.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn choose(&self, u: u64) -> Option<Choice> {
        if !(self.total > 0.0) {
            return None;
        }
        let place = (u >> 48) as u32 as f32;
        // Running sums of the weights guess the child without waiting for the division that makes
        // them parts: the processor goes on down the tree meanwhile.
        let guess = if HAS_VECTORS {
            ended(&ends(self.lanes), (place - LEFT_OVER) * self.total / ALL)
        } else {
            0
        };
        let parts = self.parts();
        let ends = ends(parts);
        let left_over = ALL - ends[WIDTH - 1];
        // What is left over belongs to the first child and comes before its own parts.
        let within = place.max(left_over) - left_over;
        let start = |child: usize| ends[child] - parts[child];
        let is_right = (start(guess) <= within) & (within < ends[guess]);
        let child = if HAS_VECTORS && is_right {
            guess
        } else {
            search(&ends, within)
        };
        let (into, parts) = if start(child) == 0.0 {
            (place, parts[child] + left_over)
        } else {
            (within - start(child), parts[child])
        };
        Some(Choice {
            child,
            probability: parts * PART,
            u: divide(to_u32(into), u << 16, to_u32(parts)),
        })
    }

    /// Probability of [`choose`](Self::choose)-ing `child`.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn probability(&self, child: usize) -> f32 {
        if !(self.total > 0.0) {
            return 0.0;
        }
        let child = child & (WIDTH - 1);
        if child == self.first() {
            // What is left over by all others.
            let parts = self.parts();
            PART * (ALL - (total(&parts) - parts[child]))
        } else {
            PART * parts_of(self.lanes[child], self.scale())
        }
    }

    /// The first child that can contribute, which takes the parts that are left over. Without
    /// branches: which one it is cannot be predicted.
    #[inline(always)]
    fn first(&self) -> usize {
        if !HAS_VECTORS {
            let first = self.lanes.iter().position(|&weight| weight > 0.0);
            return first.unwrap_or(WIDTH);
        }
        let mut positive = 0;
        for first in (0..WIDTH).step_by(4) {
            let four = Vec4::from_slice(&self.lanes[first..]);
            positive |= four.cmpgt(Vec4::ZERO).bitmask() << first;
        }
        positive.trailing_zeros() as usize
    }

    /// The parts of each child, before those that are left over go to the first.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    fn parts(&self) -> [f32; WIDTH] {
        let scale = self.scale();
        let mut parts = self.lanes;
        for parts in &mut parts {
            *parts = parts_of(*parts, scale);
        }
        parts
    }

    #[inline(always)]
    fn scale(&self) -> f32 {
        parts_scale(self.total, WIDTH)
    }
}

/// [`discrete::parts_of`](light_math::discrete::parts_of), as the compiler vectorises it.
#[inline(always)]
fn parts_of(weight: f32, scale: f32) -> f32 {
    let x = weight * scale;
    let nearest = nearest(x);
    let parts = nearest + LaneMask::when(nearest <= x).keep(1.0);
    LaneMask::when(weight > 0.0).keep(parts)
}

/// Running sums: exact for parts.
#[inline(always)]
fn ends(lanes: [f32; WIDTH]) -> [f32; WIDTH] {
    let mut ends = lanes;
    if !HAS_VECTORS {
        for k in 1..WIDTH {
            ends[k] += ends[k - 1];
        }
        return ends;
    }
    let mut before = Vec4::ZERO;
    for first in (0..WIDTH).step_by(4) {
        let x = Vec4::from_slice(&lanes[first..]);
        let pairs = x + Vec4::new(0.0, x.x, x.y, x.z);
        let four = before + (pairs + Vec4::new(0.0, 0.0, pairs.x, pairs.y));
        four.write_to_slice(&mut ends[first..]);
        before = four.wwww();
    }
    ends
}

/// How many children end at or before `place`, at most all but one.
#[inline(always)]
fn ended(ends: &[f32; WIDTH], place: f32) -> usize {
    let place = Vec4::splat(place);
    let mut ended = 0;
    for first in (0..WIDTH).step_by(4) {
        let four = Vec4::from_slice(&ends[first..]);
        ended |= four.cmple(place).bitmask() << first;
    }
    (ended.trailing_ones() as usize).min(WIDTH - 1)
}

/// The child whose parts `within` falls on.
#[cold]
fn search(ends: &[f32; WIDTH], within: f32) -> usize {
    let is_beyond = |&end: &f32| within < end;
    ends[..WIDTH - 1]
        .iter()
        .position(is_beyond)
        .unwrap_or(WIDTH - 1)
}

/// A whole number below 2^23, without the tests of a cast.
#[inline(always)]
const fn to_u32(whole: f32) -> u32 {
    (whole + 8_388_608.0).to_bits() & 0x7f_ffff
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_math::discrete;
    use light_math::fraction::stratum;

    /// The weights of the first children, 0 for the others.
    fn weights(some: &[f32]) -> Weights {
        let lanes = core::array::from_fn(|k| some.get(k).copied().unwrap_or(0.0));
        Weights {
            lanes,
            total: total(&lanes),
            ..Weights::NONE
        }
    }

    const SETS: [&[f32]; 7] = [
        &[
            0.0, 1e-7, 3.0, 0.0, 1e-9, 1e9, 1e-3, 0.0, 0.0, 7.0, 0.0, 1e3,
        ],
        &[1.0; WIDTH],
        &[1e-30, 1e30],
        &[0.0, 0.0, 1e-45],
        &[2e38, 1e38, 1.0],
        &[1.0, 2.0, 0.0, 4.0],
        &[1e-28, 2e-28, 3e-28, 0.0, 1e-29],
    ];

    #[test]
    fn all_lanes_together_choose_as_one_by_one() {
        for set in SETS {
            let weights = weights(set);
            let strata = 1 << 14;
            for i in 0..strata {
                let u = stratum(i, strata, 0x1234_5678_9abc_def0);
                let ours = weights.choose(u).expect("a weight");
                let one_by_one = discrete::sample(&weights.lanes, u).expect("a weight");
                assert_eq!(
                    (ours.child, ours.probability, ours.u),
                    (one_by_one.index, one_by_one.pmf, one_by_one.u),
                    "{set:?}, {u}"
                );
            }
            for child in 0..WIDTH {
                let pmf = discrete::pmf(&weights.lanes, child);
                assert_eq!(weights.probability(child), pmf, "{set:?}, {child}");
            }
        }
    }

    #[test]
    fn no_weight_no_choice() {
        let none = weights(&[]);
        assert!(none.choose(0).is_none(), "no weight at all");
        assert_eq!(none.probability(0), 0.0, "nor a probability");
        let not_a_number = weights(&[f32::NAN]);
        assert!(not_a_number.choose(0).is_none(), "of another's arrays");
        assert_eq!(not_a_number.probability(0), 0.0, "nor a probability");
    }
}
