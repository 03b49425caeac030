use light_bounds::LightId;
use light_bounds::light_math::distribution::WeightedReservoir;

use crate::LightChoices;

impl LightChoices<'_> {
    /// One of the choices, resampled in proportion to `target`: an estimate of what a light gives
    /// at the context that is better than the sampler's but too costly for every light.
    ///
    /// `target` is called once a candidate. It has no unit and need not be normalised; it must be
    /// above 0 for every light that contributes, since a light whose target is not positive and
    /// finite is never kept. `u` chooses the candidates, as in [`samples`](Self::samples). `fresh`
    /// returns a new random number at each call, independent of `u`: what is left of `u` after a
    /// stratified choice is not.
    ///
    /// What the kept light gives, times
    /// [`contribution_weight`](WeightedReservoir::contribution_weight), has the sum over all lights
    /// as its mean. This weight takes the place of `1 / pmf`. There is no pmf: the probability of a
    /// kept light is a sum over all combinations of candidates, so that a resampled choice is no
    /// [`LightSampler`](crate::LightSampler). For multiple importance sampling put the weight of a
    /// candidate, by [`count`](Self::count) times [`pmf`](Self::pmf), into what a light gives and
    /// best into its target: any weights that add up to 1 are unbiased.
    ///
    /// The reservoir can be kept and [merged](WeightedReservoir::merge) with those of other points
    /// or frames. The example [`resampling`][1] measures what resampling gains.
    ///
    /// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/resampling.rs
    ///
    /// ```
    /// # use light_samplers::{LightSampler, UniformLightSampler, light_bounds};
    /// # use light_bounds::{LightSampleContext, glam::Vec3};
    /// # let mut state = 0u64;
    /// # let mut fresh = || { state = state.wrapping_add(0x9e37_79b9_7f4a_7c15); state };
    /// let powers = [1.0, 2.0, 3.0, 4.0f32];
    /// let sampler = UniformLightSampler::new(4);
    /// let here = sampler.at(&LightSampleContext::medium(Vec3::ZERO), 4);
    /// let kept = here.resampled(1 << 62, |light| powers[light.index()], &mut fresh);
    /// let light = kept.value().ok_or("no light")?;
    /// let estimate = powers[light.index()] * kept.contribution_weight();
    /// // All four lights are candidates, so that the estimate is exact.
    /// assert_eq!(estimate, powers.iter().sum());
    /// # Ok::<(), &str>(())
    /// ```
    ///
    /// # Source
    /// `[Talbot2005]`, section 3; `[Bitterli2020]`, algorithm 3. Candidates are stratified here:
    /// only their average density counts.
    pub fn resampled(
        &self,
        u: u64,
        mut target: impl FnMut(LightId) -> f32,
        mut fresh: impl FnMut() -> u64,
    ) -> WeightedReservoir<LightId> {
        let mut reservoir = WeightedReservoir::new();
        for choice in self.samples(u) {
            let target = target(choice.light);
            reservoir.add(choice.light, target, target / choice.pmf, fresh());
        }
        // Choices that contribute nothing are candidates as well.
        for _ in reservoir.count()..self.count() {
            reservoir.add_none();
        }
        reservoir
    }
}
