use core::ops::Sub;

use super::position::{Narrow, STEP_BITS, STEPS, position, texel, whole_texels};
use super::quotient::quotient;
use crate::float::{next_down, next_up};

/// How an interval covers equal texels of `[0, 1]`, in whole numbers: the first and the last one in
/// part, those between in full.
///
/// Queries take the running sum `below(i)` of the weights of all texels before `i`, and count in
/// 2^-[`log2_steps`](Self::log2_steps) of its units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    texels: usize,
    min: f32,
    max: f32,
    first: usize,
    last: usize,
    cover: Cover,
}

/// What is covered.
#[derive(Clone, Copy, Debug)]
enum Cover {
    /// A part of the only texel.
    Narrow(Narrow),
    /// The steps of the first texel and of the last.
    Wide { head: u64, tail: u64 },
}

/// Where a random number leads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) texel: usize,
    pub(super) x: f32,
    /// As from [`Span::sum`].
    pub(super) total: u128,
}

/// A running sum: narrower ones make narrower products.
pub(super) trait RunningSum: Copy + Sub<Output = Self> + Into<u128> {}

impl RunningSum for u64 {}
impl RunningSum for u128 {}

impl Span {
    /// The interval from `min` to `max`, of `[0, 1]`, which rise, on `texels` texels.
    #[inline]
    pub(super) fn new(min: f32, max: f32, texels: usize) -> Self {
        let (start, end) = (position(min, texels), position(max, texels));
        let first = whole_texels(start);
        let last = whole_texels(end.saturating_sub(1)).max(first);
        let cover = if first == last {
            Cover::Narrow(Narrow::new(min, max, texels))
        } else {
            Cover::Wide {
                head: STEPS - start % STEPS,
                tail: end - ((last as u64) << STEP_BITS),
            }
        };
        Self {
            texels,
            min,
            max,
            first,
            last,
            cover,
        }
    }

    /// The sum over the interval, without any rounding but that an interval in one texel is as wide
    /// as 32 bits say; below 2^32 times the sum of the texels.
    #[inline]
    pub(super) fn sum<T: RunningSum>(&self, below: impl Fn(usize) -> T) -> u128 {
        match self.cover {
            Cover::Narrow(narrow) => {
                let weight = below(self.last + 1) - below(self.last);
                weight.into() * u128::from(narrow.width().0)
            }
            Cover::Wide { head, tail } => self.parts([head, tail], below).iter().sum(),
        }
    }

    /// The base-2 logarithm of the units of a [`sum`](Self::sum) in a weight that covers a texel.
    #[inline]
    pub(super) const fn log2_steps(&self) -> i32 {
        match self.cover {
            Cover::Narrow(narrow) => -narrow.width().1,
            Cover::Wide { .. } => STEP_BITS as i32,
        }
    }

    /// The texel and the point for `u` in `[0, 1)`; `None` if the weights are zero.
    #[inline]
    pub(super) fn choose<T: RunningSum>(
        &self,
        u: f32,
        below: impl Fn(usize) -> T,
    ) -> Option<Place> {
        let u = fraction(u);
        let (head, tail) = match self.cover {
            Cover::Wide { head, tail } => (head, tail),
            Cover::Narrow(narrow) => {
                let (texel, total) = (self.last, self.sum(below));
                let x = self.point(texel, narrow.at(u));
                return (total > 0).then_some(Place { texel, x, total });
            }
        };
        let [first, middle, last] = self.parts([head, tail], &below);
        let total = first + middle + last;
        if total == 0 {
            return None;
        }
        let target = part(total, u);
        let (texel, start, rest, weight);
        if target < first {
            (texel, start, rest) = (self.first, STEPS - head, target);
            weight = below(texel + 1) - below(texel);
        } else if target - first >= middle {
            (texel, start, rest) = (self.last, 0, target - first - middle);
            weight = below(texel + 1) - below(texel);
        } else {
            let target = target - first;
            let before = below(self.first + 1);
            let goal = before.into() + (target >> STEP_BITS);
            let sums;
            (texel, sums) = search([self.first + 1, self.last], goal, &below);
            (start, weight) = (0, sums[1] - sums[0]);
            rest = target - ((sums[0] - before).into() << STEP_BITS);
        }
        let steps = ((texel as u64) << STEP_BITS) + start + steps(rest, weight.into());
        let x = self.point(texel, (steps, -(STEP_BITS as i32)));
        Some(Place { texel, x, total })
    }

    /// The sums over the first texel, those in between, and the last one.
    #[inline]
    fn parts<T: RunningSum>(
        &self,
        [head, tail]: [u64; 2],
        below: impl Fn(usize) -> T,
    ) -> [u128; 3] {
        let ends = [self.first, self.first + 1, self.last, self.last + 1];
        let [first, inner, last, end] = ends.map(below);
        [
            (inner - first).into() * u128::from(head),
            (last - inner).into() << STEP_BITS,
            (end - last).into() * u128::from(tail),
        ]
    }

    /// The point at a position, which counts a power of two of a texel; moved by roundings until it
    /// lies in the texel and the interval.
    #[inline]
    fn point(&self, wanted: usize, (position, log2): (u64, i32)) -> f32 {
        let x = quotient(position.into(), self.texels as u128, log2);
        let mut x = x.clamp(self.min, self.max);
        // One rounding may lead over an edge of the texel, never further.
        for _ in 0..2 {
            let found = texel(x, self.texels);
            if found < wanted {
                x = next_up(x);
            } else if found > wanted {
                x = next_down(x);
            }
        }
        x
    }
}

/// `u` in 2^-32, rounded down.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast truncates on purpose, and moves any number into the range, NaN to 0"
)]
const fn fraction(u: f32) -> u32 {
    (u * STEPS as f32) as u32
}

/// The part `u` of `total`, rounded down: below `total`.
#[inline]
const fn part(total: u128, u: u32) -> u128 {
    let (high, low) = (total >> STEP_BITS, total & (STEPS - 1) as u128);
    let u = u as u128;
    high * u + ((low * u) >> STEP_BITS)
}

/// The steps of a texel of which `rest` is the sum, which is below 2^32 times its weight; to a
/// relative 2^-31.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    reason = "32 bits of the weight, and 64 of a number below 2^32 times the weight"
)]
fn steps(rest: u128, weight: u128) -> u64 {
    let shift = (u128::BITS - u32::BITS).saturating_sub(weight.leading_zeros());
    let steps = (rest >> shift) as u64 / (weight >> shift) as u64;
    steps.min(STEPS - 1)
}

/// The last texel between two whose running sum is at most `goal`, which lies between theirs, and
/// the running sums there and behind it.
#[inline]
fn search<T: RunningSum>(
    [mut low, mut high]: [usize; 2],
    goal: u128,
    below: impl Fn(usize) -> T,
) -> (usize, [T; 2]) {
    let mut sums = [below(low), below(high)];
    while high - low > 1 {
        let middle = low.midpoint(high);
        let sum = below(middle);
        if sum.into() <= goal {
            (low, sums[0]) = (middle, sum);
        } else {
            (high, sums[1]) = (middle, sum);
        }
    }
    (low, sums)
}

#[cfg(test)]
mod tests;
