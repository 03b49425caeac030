//! Choosing one of several weights, with probabilities that are whole parts of 2^16.
//!
//! Every positive weight gets at least one part, and the parts of all weights sum to 2^16: the
//! probabilities sum to exactly 1. Against exact proportion a probability among `n <= 64` weights
//! is at most a relative `n / 2^16` too small, and at most 2^-16 too large; that of the first
//! positive weight, which takes the parts that are left over, `(n + 1) / 2^16`. More weights are
//! chosen by groups of groups, each choice of at most 64.
//!
//! A choice takes and leaves a [fraction](crate::fraction) of 2^64. A larger fraction never leads
//! to an earlier weight, so that stratified fractions choose stratified weights. No step needs more
//! than 32-bit integers and single precision.
//!
//! For many weights that do not change, [`AliasTable`](crate::distribution::AliasTable) samples in
//! constant time.

use crate::fraction::divide;

/// The parts that make up probability 1.
pub const PARTS: u32 = 1 << 16;

/// The probability of one part.
pub const PART: f32 = 1.0 / 65536.0;

/// The largest number of weights of one choice.
const GROUP: usize = 64;

/// The least sum of weights that is used as it is: 2^-100.
const LEAST_TOTAL: f32 = f32::from_bits(27 << 23);

/// One of several indices, chosen with probability `pmf`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledIndex {
    /// Which one, from 0 on, in the order of the weights.
    pub index: usize,
    /// Its probability, above 0.
    pub pmf: f32,
    /// The unused part of `u`, a uniform fraction of 2^64 again.
    pub u: u64,
}

/// An index chosen in proportion to `weights`; `None` if no weight is positive.
///
/// A weight that is not positive counts as 0, an infinite one as the largest float.
///
/// ```
/// # use light_math::{discrete, fraction};
/// let chosen = discrete::sample(&[1.0, 0.0, 3.0], fraction::from_f64(0.625)).expect("a weight");
/// assert_eq!(chosen.index, 2);
/// assert!((chosen.pmf - 0.75).abs() < 1e-4);
/// ```
///
/// # Source
/// `[PBRT4]` 2.3.1, in integers.
#[inline]
#[must_use]
pub fn sample(weights: &[f32], u: u64) -> Option<SampledIndex> {
    sample_by(weights.len(), |index| weights[index], u)
}

/// The probability with which [`sample`] returns `index`, with the same bits; 0 for one that is out
/// of range.
#[inline]
#[must_use]
pub fn pmf(weights: &[f32], index: usize) -> f32 {
    pmf_by(weights.len(), |index| weights[index], index)
}

/// [`sample`] of `count` weights, of which `weight(i)` is that of index `i`. Reads a weight little
/// more than once.
#[inline]
#[must_use]
pub fn sample_by(count: usize, weight: impl Fn(usize) -> f32, u: u64) -> Option<SampledIndex> {
    let mut groups = Groups::new(0, count, &weight);
    let mut chosen = groups.sample(u)?;
    while groups.len > 1 {
        groups = groups.open(chosen.index, &weight);
        let within = groups.sample(chosen.u)?;
        let pmf = chosen.pmf * within.pmf;
        chosen = SampledIndex { pmf, ..within };
    }
    chosen.index += groups.start;
    Some(chosen)
}

/// [`pmf`] of `count` weights, of which `weight(i)` is that of index `i`.
#[inline]
#[must_use]
pub fn pmf_by(count: usize, weight: impl Fn(usize) -> f32, index: usize) -> f32 {
    if index >= count {
        return 0.0;
    }
    let mut groups = Groups::new(0, count, &weight);
    let mut pmf = groups.pmf(index);
    while groups.len > 1 {
        let group = (index - groups.start) / groups.len;
        groups = groups.open(group, &weight);
        pmf *= groups.pmf(index);
    }
    pmf
}

/// The factor from weights that sum to `total`, up to a relative 1e-5, to their parts.
///
/// One part is kept back for each of `count` weights, fewer than 2^16.
#[inline(always)]
#[must_use]
pub fn parts_scale(total: f32, count: usize) -> f32 {
    ((PARTS as usize - count) as f32 / total).min(f32::MAX)
}

/// The parts of one weight, before those that are left over go to the first positive one: at least
/// one part for a positive weight, none for any other.
#[inline(always)]
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast truncates on purpose"
)]
pub fn parts_of(weight: f32, scale: f32) -> u32 {
    if weight > 0.0 {
        1 + (weight * scale) as u32
    } else {
        0
    }
}

/// Consecutive indices in groups of equal length, but for the last.
struct Groups {
    /// The first index, and the one after the last.
    start: usize,
    end: usize,
    /// Indices in a group.
    len: usize,
    /// The sum of the weights of each group.
    sums: [f32; GROUP],
    count: usize,
}

impl Groups {
    /// The indices `start..end`.
    #[inline]
    fn new(start: usize, end: usize, weight: impl Fn(usize) -> f32) -> Self {
        let len = (end - start).div_ceil(GROUP).max(1);
        let mut groups = Self {
            start,
            end,
            len,
            sums: [0.0; GROUP],
            count: (end - start).div_ceil(len),
        };
        for (group, sum) in groups.sums[..groups.count].iter_mut().enumerate() {
            let first = start + group * len;
            *sum = total(first, (first + len).min(end), &weight);
        }
        groups.bring_within_range();
        groups
    }

    /// Multiplies all sums by a power of two, if their sum is infinite or so small that the factor
    /// to parts would be.
    #[inline]
    fn bring_within_range(&mut self) {
        let sums = &mut self.sums[..self.count];
        let unit = match sums.iter().sum::<f32>() {
            total if total > f32::MAX => 1.0 / 128.0,
            total if total < LEAST_TOTAL => 1.0 / LEAST_TOTAL,
            _ => return,
        };
        for sum in sums {
            if *sum > 0.0 {
                *sum = (*sum * unit).max(f32::MIN_POSITIVE);
            }
        }
    }

    /// The indices of one of the groups.
    #[inline]
    fn open(&self, group: usize, weight: impl Fn(usize) -> f32) -> Self {
        let start = self.start + group * self.len;
        Self::new(start, (start + self.len).min(self.end), weight)
    }

    /// The parts of each group in turn.
    #[inline]
    fn parts(&self) -> impl Iterator<Item = u32> + use<'_> {
        let (scale, mut rest) = self.scale_and_rest();
        let sums = &self.sums[..self.count];
        sums.iter().map(move |&sum| match parts_of(sum, scale) {
            0 => 0,
            parts => parts + core::mem::take(&mut rest),
        })
    }

    /// The factor from sums to parts, and how many parts it leaves over.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline)]
    fn scale_and_rest(&self) -> (f32, u32) {
        let sums = &self.sums[..self.count];
        let scale = parts_scale(sums.iter().sum(), sums.len());
        let shared: u32 = sums.iter().map(|&sum| parts_of(sum, scale)).sum();
        (scale, PARTS - shared)
    }

    /// One of the groups.
    #[inline]
    fn sample(&self, u: u64) -> Option<SampledIndex> {
        let mut place = (u >> 48) as u32;
        for (index, parts) in self.parts().enumerate() {
            if place < parts {
                let (pmf, u) = (parts as f32 * PART, divide(place, u << 16, parts));
                return Some(SampledIndex { index, pmf, u });
            }
            place -= parts;
        }
        None
    }

    /// The probability of the group of `index`.
    #[inline]
    fn pmf(&self, index: usize) -> f32 {
        let group = (index - self.start) / self.len;
        self.parts().nth(group).unwrap_or(0) as f32 * PART
    }
}

/// The sum of the positive weights of `start..end`, in blocks, so that a million equal weights lose
/// nothing that matters.
#[inline]
fn total(start: usize, end: usize, weight: impl Fn(usize) -> f32) -> f32 {
    let positive = |index| {
        let weight = weight(index);
        if weight > 0.0 { weight } else { 0.0 }
    };
    let blocks = (start..end).step_by(GROUP);
    let sum: f32 = blocks
        .map(|first| (first..(first + GROUP).min(end)).map(positive).sum::<f32>())
        .sum();
    sum.min(f32::MAX)
}

#[cfg(test)]
mod tests;
