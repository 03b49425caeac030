use super::Side;

/// The largest `f64` below one: the upper end of `u`, which lies in `[0, 1)`.
const MAX_U: f64 = 1.0 - f64::EPSILON / 2.0;

/// The choice between two children in proportion to their weights, the same for samples and for
/// queries.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fork {
    first: f32,
    second: f32,
}

impl Fork {
    /// A choice by weights of at least 0 whose sum is finite.
    #[inline]
    pub(super) const fn new(first: f32, second: f32) -> Self {
        Self { first, second }
    }

    /// One side and the unused part of `u`; `None` if both weights are 0. A side of weight 0 is
    /// never taken.
    ///
    /// Multiplies where others divide: the threshold is exact although probabilities are rounded.
    #[inline]
    pub(super) fn choose(&self, u: f64) -> Option<(Side, f64)> {
        let first = f64::from(self.first);
        let second = f64::from(self.second);
        let x = u * (first + second);
        let (side, rest) = if x < first {
            (Side::First, x / first)
        } else if self.second > 0.0 {
            (Side::Second, (x - first) / second)
        } else if self.first > 0.0 {
            // The product was rounded up, or u is 1.
            (Side::First, MAX_U)
        } else {
            return None;
        };
        Some((side, rest.clamp(0.0, MAX_U)))
    }

    /// Probability of `side`; 0 only if its weight is 0.
    #[inline]
    pub(super) fn probability(&self, side: Side) -> f32 {
        let weight = match side {
            Side::First => self.first,
            Side::Second => self.second,
        };
        if weight > 0.0 {
            (weight / (self.first + self.second)).max(f32::MIN_POSITIVE)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_testkit::edge_cases;
    use proptest::prelude::*;

    #[test]
    fn a_quarter_and_three() {
        let fork = Fork::new(1.0, 3.0);
        assert_eq!(fork.choose(0.125), Some((Side::First, 0.5)), "below");
        assert_eq!(fork.choose(0.25), Some((Side::Second, 0.0)), "at");
        assert_eq!(fork.choose(0.625), Some((Side::Second, 0.5)), "above");
        assert_eq!(fork.probability(Side::Second), 0.75, "three of four");
        let only = Fork::new(1.0, 0.0);
        assert_eq!(only.choose(1.0), Some((Side::First, MAX_U)), "beyond");
    }

    #[test]
    fn nothing_to_choose() {
        let fork = Fork::new(0.0, 0.0);
        assert_eq!(fork.choose(0.5), None, "no side");
        assert_eq!(fork.probability(Side::First), 0.0, "not 0 / 0");
    }

    proptest! {
        #[test]
        fn what_is_chosen_is_possible(
            first in edge_cases::non_negative(),
            second in edge_cases::non_negative(),
            u in edge_cases::unit_f64(),
        ) {
            let fork = Fork::new(0.25 * first, 0.25 * second);
            match fork.choose(u) {
                Some((side, rest)) => {
                    prop_assert!((0.0..1.0).contains(&rest), "{}", rest);
                    let weight = if side == Side::First { fork.first } else { fork.second };
                    prop_assert!(weight > 0.0);
                }
                None => prop_assert_eq!(fork.first + fork.second, 0.0),
            }
            let sum = fork.probability(Side::First) + fork.probability(Side::Second);
            let possible = fork.first + fork.second > 0.0;
            prop_assert!((sum - f32::from(u8::from(possible))).abs() <= f32::EPSILON, "{}", sum);
        }
    }
}
