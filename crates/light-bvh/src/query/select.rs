use light_bounds::SampledLight;
use light_math::glam::{Vec4, Vec4Swizzles};

use crate::node::wide_node::WIDTH;
use crate::query::weights::Weights;

/// A child chosen in proportion to its weight.
pub(crate) struct Choice {
    pub(crate) child: usize,
    pub(crate) probability: f32,
    /// The unused part of `u`.
    pub(crate) u: f64,
}

impl Weights {
    /// The child that `u` of `[0, 1)` falls on; `None` if no child can contribute.
    #[inline(always)]
    pub(crate) fn choose(&self, u: f64) -> Option<Choice> {
        if !(self.total > 0.0) {
            return None;
        }
        let (child, u) = pick(&self.lanes, |sum| u * sum, to_f32(u) * self.total)?;
        Some(Choice {
            child,
            probability: share(self.lanes[child], self.total),
            u,
        })
    }

    /// Probability of [`choose`](Self::choose)-ing `child`.
    #[inline(always)]
    pub(crate) fn probability(&self, child: usize) -> f32 {
        share(self.lanes[child & (WIDTH - 1)], self.total)
    }
}

/// The child that `target` of the sum of the weights, from 0 to that sum, falls on, and how far
/// into it as a part of 1.
///
/// In double precision: 24 bits cannot address the lights below children whose weights differ much,
/// and a sum in single precision may end before the last child begins. Sums in single precision
/// guess the child; a search follows only where the guess is wrong.
#[inline(always)]
pub(crate) fn pick(
    lanes: &[f32; WIDTH],
    target: impl FnOnce(f64) -> f64,
    about: f32,
) -> Option<(usize, f64)> {
    let starts = starts(lanes);
    let target = target(starts[WIDTH]);
    let guess = guess(lanes, about);
    let is_right = (starts[guess] <= target) & (target < starts[guess + 1]);
    let child = if is_right {
        guess
    } else {
        search(lanes, &starts, target)?
    };
    let rest = (target - starts[child]) / f64::from(lanes[child]);
    Some((child, rest.clamp(0.0, SampledLight::MAX_U)))
}

/// Where each child begins, and the end of the last.
#[inline(always)]
fn starts(lanes: &[f32; WIDTH]) -> [f64; WIDTH + 1] {
    let mut starts = [0.0; WIDTH + 1];
    for k in 0..WIDTH {
        starts[k + 1] = starts[k] + f64::from(lanes[k]);
    }
    starts
}

/// How many children end before `about`, in single precision.
#[inline(always)]
fn guess(lanes: &[f32; WIDTH], about: f32) -> usize {
    let about = Vec4::splat(about);
    let mut before = Vec4::ZERO;
    let mut ended = 0;
    for first in (0..WIDTH).step_by(4) {
        let x = Vec4::from_slice(&lanes[first..]);
        let pairs = x + Vec4::new(0.0, x.x, x.y, x.z);
        let ends = before + (pairs + Vec4::new(0.0, 0.0, pairs.x, pairs.y));
        ended |= ends.cmple(about).bitmask() << first;
        before = ends.wwww();
    }
    (ended.trailing_ones() as usize).min(WIDTH - 1)
}

/// `x` rounded to single precision.
#[expect(clippy::cast_possible_truncation, reason = "the rounding is intended")]
#[inline(always)]
pub(crate) const fn to_f32(x: f64) -> f32 {
    x as f32
}

/// The last child with any weight that begins before `target`: it also takes a target that rounding
/// puts beyond the sum.
#[cold]
fn search(lanes: &[f32; WIDTH], starts: &[f64; WIDTH + 1], target: f64) -> Option<usize> {
    let begins = |&child: &usize| lanes[child] > 0.0 && starts[child] <= target;
    (0..WIDTH).rev().find(begins)
}

/// `weight / total`: 0 only if the weight is.
#[inline(always)]
pub(crate) fn share(weight: f32, total: f32) -> f32 {
    if weight > 0.0 {
        (weight / total).max(f32::MIN_POSITIVE)
    } else {
        0.0
    }
}

/// The probability of two choices in turn, which never vanishes by rounding alone.
#[inline(always)]
pub(crate) fn mul_prob(a: f32, b: f32) -> f32 {
    if a > 0.0 && b > 0.0 {
        (a * b).max(f32::MIN_POSITIVE)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Children of the given weights, and empty slots.
    fn lanes(weights: &[f32]) -> [f32; WIDTH] {
        core::array::from_fn(|k| weights.get(k).copied().unwrap_or(0.0))
    }

    #[test]
    fn guesses_change_nothing() {
        let lanes = lanes(&[
            0.0, 1e-7, 3.0, 0.0, 1e-9, 1e9, 1e-3, 0.0, 0.0, 7.0, 0.0, 1e3,
        ]);
        let total: f64 = lanes.iter().map(|&w| f64::from(w)).sum();
        for i in 0..=1000 {
            for near in [0.0, 3.0, 3.001, 1e9, total] {
                let target = near + (f64::from(i) - 500.0) * 1e-9;
                if target >= 0.0 {
                    let found = pick(&lanes, |_| target, to_f32(target)).map(|(child, _)| child);
                    assert_eq!(found, search(&lanes, &starts(&lanes), target), "{target}");
                }
            }
        }
        assert!(
            pick(&[0.0; WIDTH], |_| 0.0, 0.0).is_none(),
            "no weight at all"
        );
    }

    #[test]
    fn what_is_left_of_u_is_how_far_into_the_child_it_falls() {
        let lanes = lanes(&[1.0, 0.0, 2.0, 4.0, 0.0, 0.0, 1.0]);
        assert_eq!(
            pick(&lanes, |_| 0.0, to_f32(0.0)),
            Some((0, 0.0)),
            "the first"
        );
        assert_eq!(
            pick(&lanes, |_| 1.0, to_f32(1.0)),
            Some((2, 0.0)),
            "begins where the first ends"
        );
        assert_eq!(
            pick(&lanes, |_| 4.0, to_f32(4.0)),
            Some((3, 0.25)),
            "a quarter of the way"
        );
        assert_eq!(
            pick(&lanes, |_| 8.0, to_f32(8.0)),
            Some((6, SampledLight::MAX_U)),
            "beyond the end"
        );
    }
}
