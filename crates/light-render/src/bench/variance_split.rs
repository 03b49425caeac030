/// The contribution of a light to a receiver, over equally likely points of the light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightMoments {
    /// Mean of the arriving light.
    pub mean: f64,
    /// Mean of its square.
    pub square: f64,
    /// Mean of the unoccluded light.
    pub unoccluded: f64,
}

/// The variance of the estimate by one choice of a light and of a point on it: the arriving light
/// over the light's probability.
///
/// With `p` the probabilities, `f` and `s` the means of the arriving light and of its square, and
/// `F` the sum of `f`, it is `sum s / p - F^2`: between lights `sum f^2 / p - F^2`, which is 0
/// where `p` is in proportion to `f`, and within lights `sum (s - f^2) / p`, the penumbrae and the
/// forms of lights, which better choices can lower but not remove.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VarianceSplit {
    /// The arriving light of all lights.
    pub total: f64,
    /// The part of it from lights of probability 0.
    pub lost: f64,
    /// The variance between lights.
    pub between: f64,
    /// The variance within lights.
    pub within: f64,
}

impl LightMoments {
    /// Of at least one point, each given by its unoccluded and its arriving light.
    pub(super) fn over(points: impl ExactSizeIterator<Item = [f64; 2]>) -> Self {
        let weight = 1.0 / points.len() as f64;
        points.fold(Self::default(), |sum, [unoccluded, arrives]| Self {
            mean: sum.mean + weight * arrives,
            square: sum.square + weight * arrives * arrives,
            unoccluded: sum.unoccluded + weight * unoccluded,
        })
    }

    /// The share of the unoccluded light that arrives; 0 without light.
    #[must_use]
    pub fn seen(&self) -> f64 {
        if self.unoccluded > 0.0 {
            self.mean / self.unoccluded
        } else {
            0.0
        }
    }
}

impl VarianceSplit {
    /// Of lights with the probabilities that they are chosen with, whose sum is at most 1.
    pub fn of(lights: impl IntoIterator<Item = (LightMoments, f64)>) -> Self {
        let mut split = Self::default();
        let (mut squares, mut reached) = (0.0, 0.0);
        for (light, pmf) in lights {
            split.total += light.mean;
            if pmf > 0.0 {
                reached += light.mean;
                squares += light.mean * light.mean / pmf;
                split.within += (light.square - light.mean * light.mean).max(0.0) / pmf;
            } else {
                split.lost += light.mean;
            }
        }
        split.between = (squares - reached * reached).max(0.0);
        split
    }

    /// Of choices in proportion to `weight`, which is not negative.
    pub(super) fn in_proportion(
        lights: &[LightMoments],
        weight: impl Fn(&LightMoments) -> f64,
    ) -> Self {
        let sum: f64 = lights.iter().map(&weight).sum();
        if sum > 0.0 {
            Self::of(lights.iter().map(|light| (*light, weight(light) / sum)))
        } else {
            Self::of(lights.iter().map(|light| (*light, 0.0)))
        }
    }

    /// Of the best choice: in proportion to the root of the second moment of the arriving light.
    #[must_use]
    pub fn best(lights: &[LightMoments]) -> Self {
        Self::in_proportion(lights, |light| light.square.sqrt())
    }

    /// Between and within lights together.
    #[must_use]
    pub fn sum(&self) -> f64 {
        self.between + self.within
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three lights of four points: in the open, in penumbra, hidden.
    const ARRIVES: [[f64; 4]; 3] = [[2.0, 2.5, 3.0, 2.25], [1.0, 0.0, 0.0, 1.5], [0.0; 4]];

    fn lights() -> [LightMoments; 3] {
        ARRIVES.map(|points| LightMoments::over(points.into_iter().map(|f| [2.0, f])))
    }

    /// Mean and variance over every choice and point, each with its probability.
    fn by_brute_force(pmf: [f64; 3]) -> [f64; 2] {
        let nothing = 1.0 - pmf.iter().sum::<f64>();
        let mut outcomes = vec![(0.0, nothing)];
        for (points, p) in ARRIVES.into_iter().zip(pmf) {
            outcomes.extend(points.map(|f| (f / p, p / 4.0)));
        }
        let mean: f64 = outcomes.iter().map(|(x, p)| x * p).sum();
        let variance = outcomes.iter().map(|(x, p)| (x - mean) * (x - mean) * p);
        [mean, variance.sum()]
    }

    #[test]
    fn the_parts_add_up_to_the_variance_of_all_outcomes() {
        for pmf in [[0.5, 0.25, 0.25], [0.2, 0.3, 0.1], [0.9, 0.05, 0.05]] {
            let split = VarianceSplit::of(lights().into_iter().zip(pmf));
            let [mean, variance] = by_brute_force(pmf);
            assert!((split.total - mean).abs() < 1e-12, "{pmf:?}: {split:?}");
            let error = (split.sum() - variance).abs();
            assert!(error < 1e-12 * variance, "{pmf:?}: {split:?}, {variance}");
        }
    }

    #[test]
    fn choices_in_proportion_to_means_leave_what_is_within() {
        let split = VarianceSplit::in_proportion(&lights(), |light| light.mean);
        assert!(split.between < 1e-12, "{split:?}");
        assert!(split.within > 0.0, "{split:?}");
        assert_eq!(split.lost, 0.0, "the hidden light gives nothing");
    }

    #[test]
    fn nothing_is_below_the_best() {
        let best = VarianceSplit::best(&lights()).sum();
        for pmf in [[0.6, 0.4, 0.0], [0.7, 0.3, 0.0], [0.8, 0.2, 0.0]] {
            let other = VarianceSplit::of(lights().into_iter().zip(pmf)).sum();
            assert!(other >= best, "{other} against {best} at {pmf:?}");
        }
    }

    #[test]
    fn lights_that_are_never_chosen_are_lost() {
        let split = VarianceSplit::of(lights().into_iter().zip([1.0, 0.0, 0.0]));
        assert_eq!(split.lost, 0.625, "the mean of the second");
        assert_eq!(lights()[1].seen(), 0.3125, "of 2");
        let dark = VarianceSplit::best(&[LightMoments::default()]);
        assert_eq!(dark, VarianceSplit::default(), "nothing arrives");
    }
}
