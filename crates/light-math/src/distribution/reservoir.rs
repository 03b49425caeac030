use crate::fraction::is_below;

/// One of a stream of candidates, kept in proportion to weights that are known one at a time, and
/// what makes it an unbiased sample.
///
/// Resampled importance sampling: candidates are drawn as a source draws them, with density `p`,
/// and one is kept with a probability in proportion to its *resampling weight* `target / p`. The
/// target is any non-negative estimate of what the candidate contributes; it need not be
/// normalised. For a function `f` whose target is above 0 wherever `f` is not 0, `f(value) *
/// `[`contribution_weight`](Self::contribution_weight) has the sum (or integral) of `f` as its
/// mean: the weight takes the place of `1 / p`. There is no density to weight it by against another
/// strategy, since that of a kept value has no closed form; weight the candidates, as a factor of
/// `f`.
///
/// A reservoir holds no random number: it can be stored, get more candidates, and be
/// [merged](Self::merge) into that of another receiver. Every candidate takes a fresh `u`,
/// independent of how candidates are drawn; the bits of a single one would not last.
///
/// ```
/// # use light_math::distribution::WeightedReservoir;
/// # let mut random = [1u64 << 62, 1 << 63].into_iter();
/// // Four numbers, drawn uniformly; their squares are the target, the sum of cubes is wanted.
/// let numbers = [1.0f32, 2.0, 3.0, 4.0];
/// let mut reservoir = WeightedReservoir::new();
/// for (index, u) in [1, 3].into_iter().zip(&mut random) {
///     let target = numbers[index].powi(2);
///     reservoir.add(index, target, target / 0.25, u);
/// }
/// let kept = *reservoir.value().expect("a positive weight");
/// let cubes = numbers[kept].powi(3) * reservoir.contribution_weight();
/// assert_eq!((kept, cubes), (3, 64.0 * 80.0 / (2.0 * 16.0)));
/// ```
///
/// # Source
/// `[Chao1982]` for the stream, `[Talbot2005]` 3 for the weights, `[Bitterli2020]` algorithms 2 to
/// 4 and 6 for reservoirs that are kept and merged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightedReservoir<T> {
    kept: Option<Kept<T>>,
    total: f32,
    count: u32,
}

/// The value of a reservoir, and its target, which is positive and finite.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Kept<T> {
    value: T,
    target: f32,
}

impl<T> Default for WeightedReservoir<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> WeightedReservoir<T> {
    /// A reservoir of no candidate.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            kept: None,
            total: 0.0,
            count: 0,
        }
    }

    /// Offers a candidate with its target and its resampling weight: the target over the density
    /// with which the candidate was drawn. `u` is a fresh [fraction](crate::fraction) of 2^64.
    ///
    /// A target or a weight that is not positive and finite never wins; the candidate counts. The
    /// sum of weights stays at `f32::MAX` once it gets there. It is rounded at each addition, so
    /// that after `n` candidates it is a relative `n * 2^-24` off at most.
    #[inline]
    pub fn add(&mut self, value: T, target: f32, weight: f32, u: u64) {
        self.count = self.count.saturating_add(1);
        self.offer(value, target, weight, u);
    }

    /// Counts a draw that has produced no candidate.
    #[inline]
    pub const fn add_none(&mut self) {
        self.count = self.count.saturating_add(1);
    }

    /// Adds all candidates of `other` as if they were offered one by one. `target` is that of this
    /// reservoir, of the value that `other` kept; it may be another than the one `other` had.
    ///
    /// With one target the merged reservoir is distributed as one of all candidates; otherwise see
    /// [`contribution_weight`](Self::contribution_weight).
    ///
    /// # Source
    /// `[Bitterli2020]`, algorithm 4.
    #[inline]
    pub fn merge(&mut self, other: Self, target: impl FnOnce(&T) -> f32, u: u64) {
        self.count = self.count.saturating_add(other.count);
        if let Some(kept) = other.kept {
            let target = target(&kept.value);
            let weight = (target / kept.target * other.total).min(f32::MAX);
            self.offer(kept.value, target, weight, u);
        }
    }

    /// Keeps `value` with the probability that its weight has of all so far.
    #[inline]
    fn offer(&mut self, value: T, target: f32, weight: f32, u: u64) {
        let is_valid = |x: f32| x > 0.0 && x.is_finite();
        if !(is_valid(target) && is_valid(weight)) {
            return;
        }
        self.total = (self.total + weight).min(f32::MAX);
        if is_below(u, weight / self.total) {
            self.kept = Some(Kept { value, target });
        }
    }

    /// The kept value; `None` while no weight was positive.
    #[must_use]
    pub const fn value(&self) -> Option<&T> {
        match &self.kept {
            Some(kept) => Some(&kept.value),
            None => None,
        }
    }

    /// The target of the kept value; 0 without one.
    #[must_use]
    pub const fn target(&self) -> f32 {
        match &self.kept {
            Some(kept) => kept.target,
            None => 0.0,
        }
    }

    /// The sum of all resampling weights. Divided by [`count`](Self::count) its mean is the sum (or
    /// integral) of the target.
    #[must_use]
    pub const fn total(&self) -> f32 {
        self.total
    }

    /// How many candidates there were, those of no weight included: `M` of the source.
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }

    /// Lets the candidates so far count as at most `count` when more are added. The contribution
    /// weight stays.
    ///
    /// A reservoir that is kept from frame to frame needs it: old candidates would outnumber new
    /// ones more and more.
    ///
    /// # Source
    /// `[Bitterli2020]`, section 5: at most 20 times as many as those of a frame.
    pub fn limit_count(&mut self, count: u32) {
        if count < self.count {
            self.total *= count as f32 / self.count as f32;
            self.count = count;
        }
    }

    /// What an estimate multiplies the kept value's contribution by: the sum of weights over `count
    /// * target`. 0 without a value; at most `f32::MAX`.
    ///
    /// Unbiased if every candidate came from a source that reaches all that contributes here: where
    /// the reservoirs that were merged had a target of 0 at what contributes here, the mean is too
    /// small. See [`contribution_weight_among`](Self::contribution_weight_among).
    ///
    /// # Source
    /// `[Talbot2005]`, equation 6; `[Bitterli2020]`, equation 6.
    #[must_use]
    pub fn contribution_weight(&self) -> f32 {
        self.contribution_weight_among(self.count)
    }

    /// [`contribution_weight`](Self::contribution_weight) with another number of candidates, which
    /// may depend on the kept value.
    ///
    /// After merging reservoirs with unlike targets, an unbiased number is the sum of the
    /// [`count`](Self::count)s of those whose own target of the kept value is above 0. It takes one
    /// target a reservoir, and is noisy where a target is small but not 0. Weights allow that:
    /// offer the kept value of each reservoir by [`add`](Self::add) with the weight
    /// `m * target * contribution_weight`, where the numbers `m` that the reservoirs have for one
    /// value add up to 1, and take 1 here.
    ///
    /// # Source
    /// `[Bitterli2020]`, algorithm 6, and its section 4.3 for the weights `m`.
    #[must_use]
    pub fn contribution_weight_among(&self, count: u32) -> f32 {
        match &self.kept {
            Some(kept) if count > 0 => (self.total / kept.target).min(f32::MAX) / count as f32,
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests;
