/// The largest `u` that a random number of 53 bits may have.
const LARGEST_U: f64 = 1.0 - f64::EPSILON / 2.0;

/// `u` forced into `[0, 1)`; 0 for NaN.
#[inline]
pub(super) fn unit(u: f64) -> f64 {
    if u > 0.0 { u.min(LARGEST_U) } else { 0.0 }
}

/// One of a stream of values, chosen in proportion to weights that are known one at a time.
///
/// One `u` serves the whole stream: each choice uses a part of it and passes on the rest. The rest
/// stays accurate as long as the first weights are not vanishingly small against the sum, which is
/// what the 53 bits of an `f64` are for.
///
/// ```
/// # use light_math::distribution::WeightedReservoir;
/// let mut reservoir = WeightedReservoir::new(0.75);
/// reservoir.add('a', 1.0);
/// reservoir.add('b', 3.0);
/// let chosen = reservoir.sample().expect("a positive weight");
/// assert_eq!((chosen.value, chosen.pmf), ('a', 0.25));
/// ```
///
/// # Source
/// `[Chao1982]`, with the remapped `u` of `[PBRT4]` 2.3.1 in place of a new one for each value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightedReservoir<T> {
    kept: Option<(T, f64)>,
    total: f64,
    u: f64,
}

/// A value chosen with probability `pmf`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledValue<T> {
    /// The value.
    pub value: T,
    /// Its probability, above 0.
    pub pmf: f32,
    /// The unused part of `u`, uniform in `[0, 1)` again.
    pub u: f64,
}

impl<T> WeightedReservoir<T> {
    /// An empty reservoir that chooses by `u` in `[0, 1)`.
    #[must_use]
    pub fn new(u: f64) -> Self {
        Self {
            kept: None,
            total: 0.0,
            u: unit(u),
        }
    }

    /// Offers `value`; a weight that is not a positive finite number never wins.
    #[inline]
    pub fn add(&mut self, value: T, weight: f32) {
        if !(weight > 0.0 && weight.is_finite()) {
            return;
        }
        let weight = f64::from(weight);
        self.total += weight;
        let chance = weight / self.total;
        if self.u < chance {
            self.u = unit(self.u / chance);
            self.kept = Some((value, weight));
        } else {
            self.u = unit((self.u - chance) / (1.0 - chance));
        }
    }

    /// The sum of the weights so far.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.total
    }

    /// The chosen value; `None` while no weight was positive, or if its probability is below the
    /// range of `f32`.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "rounds a probability")]
    pub fn sample(self) -> Option<SampledValue<T>> {
        let (value, weight) = self.kept?;
        let pmf = (weight / self.total) as f32;
        let u = self.u;
        (pmf > 0.0).then_some(SampledValue { value, pmf, u })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choose(weights: &[f32], u: f64) -> Option<SampledValue<usize>> {
        let mut reservoir = WeightedReservoir::new(u);
        for (index, &weight) in weights.iter().enumerate() {
            reservoir.add(index, weight);
        }
        reservoir.sample()
    }

    #[test]
    fn the_total_is_that_of_all_weights() {
        let mut reservoir = WeightedReservoir::new(0.5);
        assert_eq!(reservoir.total(), 0.0, "none yet");
        for weight in [0.25, 0.0, 2.0] {
            reservoir.add((), weight);
        }
        assert_eq!(reservoir.total(), 2.25, "of three");
    }

    #[test]
    fn a_probability_below_the_range_of_floats_is_none() {
        assert_eq!(choose(&[1e30, 1e-30], 0.0), None, "1e-60");
        let least = choose(&[1e30, 1e-6], 0.0).expect("1e-36");
        assert!(least.value == 1 && least.pmf > 0.0, "{least:?}");
    }

    #[test]
    fn even_u_gives_even_shares_and_an_even_rest() {
        let weights = [1.0, 0.0, 2.0, 5.0];
        let mut counts = [0; 4];
        let mut rests = 0.0;
        for i in 0..8000 {
            let s = choose(&weights, (f64::from(i) + 0.5) / 8000.0).expect("positive weights");
            assert_eq!(s.pmf, weights[s.value] / 8.0, "probability");
            counts[s.value] += 1;
            rests += s.u / 8000.0;
        }
        assert_eq!(counts, [1000, 0, 2000, 5000], "shares");
        assert!((rests - 0.5).abs() < 1e-3, "mean of what is left: {rests}");
    }

    #[test]
    fn nonsense_never_wins() {
        let weights = [f32::NAN, -1.0, f32::INFINITY, 0.0, 1e-30, f32::NAN];
        for u in [0.0, 0.5, 1.0, 7.0, f64::NAN] {
            let s = choose(&weights, u).expect("a positive weight");
            assert_eq!((s.value, s.pmf), (4, 1.0), "the only one, u = {u}");
            assert!((0.0..1.0).contains(&s.u), "rest {}", s.u);
        }
        assert_eq!(choose(&weights[..4], 0.5), None, "no positive weight");
        assert_eq!(choose(&[], 0.5), None, "no weight");
    }
}
