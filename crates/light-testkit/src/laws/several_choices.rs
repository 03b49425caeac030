use light_bounds::LightSampleContext;
use light_math::fraction;
use light_samplers::LightSampler;

use crate::{Rng, SamplerCase, chi_squared, kolmogorov_smirnov_uniform};

/// Several choices at one context carry the bits of their queried pmfs, which add up to one at most
/// and are the same whenever they are prepared; they fall on lights as often as their pmf, and
/// leave a uniform rest of `u` for each of them. They may be fewer than asked for, not more.
///
/// They are stratified, so counts vary less than independent ones: the test errs on
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
    let here = sampler.at(ctx, count);
    let pmfs: Vec<f32> = set.ids().map(|id| here.pmf(id)).collect();
    let made = here.count();
    assert!(made <= count, "{at}: {made} are made, more than asked for");
    assert!(
        made > 0 || pmfs.iter().all(|&pmf| pmf == 0.0),
        "{at}: none is made, although lights have a pmf"
    );
    let mut rests = vec![Vec::new(); pmfs.len()];
    for _ in 0..calls {
        for chosen in here.samples(rng.u64()) {
            let Some(pmf) = pmfs.get(chosen.light.index()) else {
                panic!("{at}: {chosen:?} of an unknown light");
            };
            assert_eq!(
                chosen.pmf.to_bits(),
                pmf.to_bits(),
                "{at}: {chosen:?}, but the queried pmf is {pmf}"
            );
            rests[chosen.light.index()].push(fraction::to_f64(chosen.u));
        }
    }
    let again = sampler.at(ctx, count);
    for (id, pmf) in set.ids().zip(&pmfs) {
        let asked = again.pmf(id);
        assert_eq!(
            asked.to_bits(),
            pmf.to_bits(),
            "{at}: the pmf of {id:?} is {pmf}, and {asked} when prepared again"
        );
    }

    let draws = f64::from(calls * made);
    let mut observed: Vec<u64> = rests.iter().map(|rest| rest.len() as u64).collect();
    let mut expected: Vec<f64> = pmfs.iter().map(|&pmf| f64::from(pmf) * draws).collect();
    observed.push(u64::from(calls * made) - observed.iter().sum::<u64>());
    let sum: f64 = expected.iter().sum();
    assert!(
        sum <= draws * (1.0 + super::sampler::ROUNDING),
        "{at}: the pmfs sum to {}",
        sum / draws
    );
    expected.push((draws - sum).max(0.0));
    let outcome = chi_squared(&observed, &expected);
    assert!(
        outcome.passes(),
        "{at}: lights, and none at the end, were chosen {observed:?} times, expected {expected:?}: \
         {outcome:?}"
    );

    let rests = rests.iter_mut().enumerate();
    for (light, rest) in rests.filter(|(_, rest)| rest.len() >= ENOUGH_FOR_U) {
        let outcome = kolmogorov_smirnov_uniform(rest);
        assert!(
            outcome.passes(),
            "{at}: the rest of u is not uniform for light {light}: {outcome:?}"
        );
    }
}
