use light_bounds::LightSampleContext;
use light_samplers::{LightSampler, PreparedChoices};

use crate::{Rng, SamplerCase, chi_squared, kolmogorov_smirnov_uniform};

/// Several choices of one call carry the bits of `pmf_many`, which adds up to one at most, fall on
/// lights as often as their pmf, and leave a uniform rest of `u` for each of them; prepared
/// choices give the same pmfs.
///
/// Choices of one call are stratified, so counts vary less than independent ones: the test errs on
/// the safe side.
///
/// # Panics
/// If the law does not hold.
pub fn several_choices_follow_their_pmf(set: &SamplerCase, sampler: &impl LightSampler) {
    const DRAWS: u32 = 1 << 13;
    let mut rng = Rng::new(34);
    let step = usize::max(1, set.contexts.len() / 2);
    for ctx in set.contexts.iter().step_by(step) {
        for count in [2, 5] {
            check(set, sampler, ctx, count, DRAWS / count, &mut rng);
        }
    }
}

fn check(
    set: &SamplerCase,
    sampler: &impl LightSampler,
    ctx: &LightSampleContext,
    count: u32,
    calls: u32,
    rng: &mut Rng,
) {
    const ENOUGH_FOR_U: usize = 200;
    let at = format!("{}: {count} choices at {ctx:?}", set.name);
    let pmfs: Vec<f32> = set
        .ids()
        .map(|id| sampler.pmf_many(ctx, id, count))
        .collect();
    let mut prepared = PreparedChoices::default();
    let mut rests = vec![Vec::new(); pmfs.len()];
    for _ in 0..calls {
        sampler.sample_many_prepared(ctx, rng.f64(), count, &mut prepared, &mut |chosen| {
            let pmf = pmfs[chosen.light.index()];
            assert_eq!(chosen.pmf.to_bits(), pmf.to_bits(), "{at}: {chosen:?}");
            rests[chosen.light.index()].push(chosen.u);
        });
    }
    for (id, pmf) in set.ids().zip(&pmfs) {
        let kept = sampler.pmf_many_prepared(ctx, id, count, &prepared);
        assert_eq!(
            kept.to_bits(),
            pmf.to_bits(),
            "{at}: {id:?} by the prepared"
        );
    }

    let draws = f64::from(calls * count);
    let mut observed: Vec<u64> = rests.iter().map(|rest| rest.len() as u64).collect();
    let mut expected: Vec<f64> = pmfs.iter().map(|&pmf| f64::from(pmf) * draws).collect();
    observed.push(u64::from(calls * count) - observed.iter().sum::<u64>());
    let sum: f64 = expected.iter().sum();
    assert!(
        sum <= draws * (1.0 + super::sampler::ROUNDING),
        "{at}: {sum} of {draws}"
    );
    expected.push((draws - sum).max(0.0));
    let outcome = chi_squared(&observed, &expected);
    assert!(
        outcome.passes(),
        "{at}: {observed:?} of {expected:?}: {outcome:?}"
    );

    let rests = rests.iter_mut().enumerate();
    for (light, rest) in rests.filter(|(_, rest)| rest.len() >= ENOUGH_FOR_U) {
        let outcome = kolmogorov_smirnov_uniform(rest);
        assert!(
            outcome.passes(),
            "{at}: the rest of u for light {light}: {outcome:?}"
        );
    }
}
