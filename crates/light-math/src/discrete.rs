//! Choosing one of a few weights by walking over them.
//!
//! For many weights that do not change, [`AliasTable`](crate::distribution::AliasTable) answers in
//! constant time.

/// One of several indices, chosen with probability `pmf`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledIndex {
    /// Which one, from 0 on, in the order of the weights.
    pub index: usize,
    /// Its probability, above 0.
    pub pmf: f32,
    /// The unused part of `u`, uniform in `[0, 1)` again.
    pub u: f64,
}

/// The largest `u` that a random number of 53 bits may have.
const LARGEST_U: f64 = 1.0 - f64::EPSILON / 2.0;

/// `u` forced into `[0, 1)`; 0 for NaN.
#[inline]
pub(crate) fn unit(u: f64) -> f64 {
    if u > 0.0 { u.min(LARGEST_U) } else { 0.0 }
}

/// An index chosen in proportion to `weights`; `None` if no weight is positive.
///
/// `u` is in `[0, 1)`; it is an `f64` because the 24 bits of an `f32` are soon used up where
/// choices follow one another. A weight that is not a positive finite number counts as 0. Two walks
/// over the weights.
///
/// # Source
/// `[PBRT4]` 2.3.1, where zero weights at the end need no special case.
#[inline]
#[must_use]
pub fn sample(weights: &[f32], u: f64) -> Option<SampledIndex> {
    let total = total(weights);
    let target = unit(u) * total;
    let mut below = 0.0;
    let mut chosen = None;
    for (index, &weight) in weights.iter().enumerate() {
        let weight = effective(weight);
        let pmf = probability(weight, total);
        if !(pmf > 0.0) {
            continue;
        }
        let u = unit((target - below) / weight);
        chosen = Some(SampledIndex { index, pmf, u });
        below += weight;
        if target < below {
            break;
        }
    }
    chosen
}

/// The probability with which [`sample`] returns `index`; 0 for one that is out of range.
#[inline]
#[must_use]
pub fn pmf(weights: &[f32], index: usize) -> f32 {
    match weights.get(index) {
        Some(&weight) => probability(effective(weight), total(weights)),
        None => 0.0,
    }
}

#[inline]
fn total(weights: &[f32]) -> f64 {
    weights.iter().map(|&weight| effective(weight)).sum()
}

#[inline]
fn effective(weight: f32) -> f64 {
    if weight > 0.0 && weight.is_finite() {
        f64::from(weight)
    } else {
        0.0
    }
}

#[inline]
#[expect(clippy::cast_possible_truncation, reason = "rounds a probability")]
fn probability(weight: f64, total: f64) -> f32 {
    if total > 0.0 {
        (weight / total) as f32
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remaps_u_within_the_chosen_weight() {
        let s = sample(&[1.0, 0.0, 3.0], 0.625).expect("a positive weight");
        assert_eq!(
            (s.index, s.pmf, s.u),
            (2, 0.75, 0.5),
            "second positive weight"
        );
        let s = sample(&[1.0, 0.0, 3.0], 0.125).expect("a positive weight");
        assert_eq!((s.index, s.pmf, s.u), (0, 0.25, 0.5), "first");
    }

    #[test]
    fn never_returns_a_weight_that_counts_as_zero() {
        let weights = [0.0, f32::NAN, 2.0, -1.0, f32::INFINITY, 1e-45, 0.0];
        for u in [0.0, 0.5, LARGEST_U, 1.0, 2.0, f64::NAN] {
            let s = sample(&weights, u).expect("a positive weight");
            assert_eq!(s.index, 2, "u = {u}");
            assert_eq!(s.pmf, pmf(&weights, s.index), "same bits");
            assert!((0.0..1.0).contains(&s.u), "range of what is left: {}", s.u);
        }
    }

    #[test]
    fn nothing_to_choose() {
        assert_eq!(sample(&[], 0.5), None, "no weights");
        assert_eq!(sample(&[0.0, f32::NAN], 0.5), None, "none positive");
        assert_eq!(pmf(&[1.0], 7), 0.0, "out of range");
    }
}
