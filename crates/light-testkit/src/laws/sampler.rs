//! The laws of light samplers, each a function of a sampler and of the lights it was built from.

use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_math::fraction;
use light_samplers::LightSampler;

use crate::{Rng, SamplerCase, chi_squared, edge_cases, kolmogorov_smirnov_uniform};

/// A query at a context, or for emission, without one.
type Query = Option<LightSampleContext>;

fn queries(set: &SamplerCase) -> impl Iterator<Item = Query> {
    set.contexts.iter().copied().map(Some).chain([None])
}

fn sample(sampler: &impl LightSampler, query: &Query, u: u64) -> Option<SampledLight> {
    match query {
        Some(ctx) => sampler.sample(ctx, u),
        None => sampler.sample_emitter(u),
    }
}

fn pmf(sampler: &impl LightSampler, query: &Query, light: LightId) -> f32 {
    match query {
        Some(ctx) => sampler.pmf(ctx, light),
        None => sampler.pmf_emitter(light),
    }
}

/// A sample is of a light of the set, and its pmf has the bits of the queried pmf.
///
/// # Panics
/// If the law does not hold.
pub fn sampled_pmf_is_the_queried_pmf(set: &SamplerCase, sampler: &impl LightSampler) {
    let mut rng = Rng::new(31);
    for query in queries(set) {
        let edges = edge_cases::EDGES_OF_U.map(|u| fraction::from_f32(u, 0));
        let random: Vec<u64> = (0..256).map(|_| rng.u64()).collect();
        for u in edges.into_iter().chain([u64::MAX]).chain(random) {
            let Some(chosen) = sample(sampler, &query, u) else {
                continue;
            };
            let asked = pmf(sampler, &query, chosen.light);
            let name = set.name;
            assert!(
                chosen.light.index() < set.emitters.len(),
                "{name}: {chosen:?} of an unknown light at u = {u}, {query:?}"
            );
            assert_eq!(
                chosen.pmf.to_bits(),
                asked.to_bits(),
                "{name}: {chosen:?}, but the queried pmf is {asked} at u = {u}, {query:?}"
            );
            assert!(
                chosen.pmf > 0.0 && chosen.pmf <= 1.0,
                "{name}: {chosen:?} is out of range at u = {u}, {query:?}"
            );
        }
    }
}

/// The pmfs of all lights and the probability of `None` add up to one.
///
/// # Panics
/// If the law does not hold.
pub fn pmfs_and_none_sum_to_one(set: &SamplerCase, sampler: &impl LightSampler) {
    // Stratified u: a sampler that maps each light to an interval misses by less than one stratum a
    // light.
    const STRATA: u32 = 4096;
    let mut rng = Rng::new(32);
    for query in queries(set) {
        let sum: f64 = set
            .ids()
            .map(|id| f64::from(pmf(sampler, &query, id)))
            .sum();
        let none = (0..STRATA)
            .filter(|&i| {
                let u = fraction::stratum(i, STRATA, rng.u64());
                sample(sampler, &query, u).is_none()
            })
            .count();
        let p_none = none as f64 / f64::from(STRATA);
        // The spread of the count that the pmfs predict, and three strata more: rare outcomes occur
        // now and then.
        let predicted = (1.0 - sum).clamp(0.0, 1.0);
        let spread = (predicted * (1.0 - predicted) / f64::from(STRATA)).sqrt();
        let margin = 5.0 * spread + 3.0 / f64::from(STRATA);
        let error = (sum + p_none - 1.0).abs();
        assert!(
            sum <= 1.0 + ROUNDING && error <= ROUNDING + margin,
            "{}: the pmfs sum to {sum}, none is returned with {p_none} at {query:?}",
            set.name
        );
    }
}

/// The rounding error of a sum of many pmfs in `f32`.
pub(super) const ROUNDING: f64 = 2e-5;

/// A light that contributes at a context has a pmf above zero; no pmf is NaN or above one.
///
/// # Panics
/// If the law does not hold.
pub fn contributing_lights_can_be_chosen(set: &SamplerCase, sampler: &impl LightSampler) {
    for ctx in &set.contexts {
        for (id, emitter) in set.ids().zip(&set.emitters) {
            let (pmf, contribution) = (sampler.pmf(ctx, id), emitter.contribution(ctx));
            assert!(
                (0.0..=1.0).contains(&pmf),
                "{}: pmf {pmf} of {id:?} at {ctx:?}",
                set.name
            );
            assert!(
                pmf > 0.0 || contribution == 0.0,
                "{}: {id:?} contributes {contribution} and is never chosen at {ctx:?}: {emitter:?}",
                set.name
            );
        }
    }
    for (id, power) in set.ids().zip(set.powers()) {
        assert!(
            sampler.pmf_emitter(id) > 0.0 || power == 0.0,
            "{}: {id:?} emits {power} and is never chosen to emit",
            set.name
        );
    }
}

/// Lights outside of the set have pmf zero.
///
/// # Panics
/// If the law does not hold.
pub fn unknown_lights_have_no_pmf(set: &SamplerCase, sampler: &impl LightSampler) {
    let n = set.count();
    for query in queries(set) {
        for id in [n, n + 1, 1 << 24, u32::MAX >> 1, u32::MAX] {
            let pmf = pmf(sampler, &query, LightId(id));
            assert_eq!(
                pmf, 0.0,
                "{}: pmf of unknown light {id} at {query:?}",
                set.name
            );
        }
    }
}

/// Lights are chosen as often as their pmf says, and the rest of `u` is uniform for each of them.
///
/// # Panics
/// If the law does not hold.
pub fn frequencies_match_and_u_stays_uniform(set: &SamplerCase, sampler: &impl LightSampler) {
    const DRAWS: u32 = 8192;
    const ENOUGH_FOR_U: usize = 200;
    let mut rng = Rng::new(33);
    let step = usize::max(1, set.contexts.len() / 4);
    let queries: Vec<Query> = queries(set).step_by(step).collect();
    for query in &queries {
        let mut rests = vec![Vec::new(); set.emitters.len()];
        let mut none = 0;
        for _ in 0..DRAWS {
            match sample(sampler, query, rng.u64()) {
                Some(chosen) => match rests.get_mut(chosen.light.index()) {
                    Some(rest) => rest.push(fraction::to_f64(chosen.u)),
                    None => panic!("{}: {chosen:?} of an unknown light at {query:?}", set.name),
                },
                None => none += 1,
            }
        }
        let mut expected: Vec<f64> = set
            .ids()
            .map(|id| f64::from(pmf(sampler, query, id)))
            .collect();
        expected.push((1.0 - expected.iter().sum::<f64>()).max(0.0));
        expected.iter_mut().for_each(|p| *p *= f64::from(DRAWS));
        let mut observed: Vec<u64> = rests.iter().map(|rest| rest.len() as u64).collect();
        observed.push(none);
        let outcome = chi_squared(&observed, &expected);
        assert!(
            outcome.passes(),
            "{}: lights, and none at the end, were chosen {observed:?} times, expected \
             {expected:?}, at {query:?}: {outcome:?}",
            set.name
        );

        let lights = rests.iter_mut().enumerate();
        for (light, rest) in lights.filter(|(_, rest)| rest.len() >= ENOUGH_FOR_U) {
            let outcome = kolmogorov_smirnov_uniform(rest);
            assert!(
                outcome.passes(),
                "{}: the rest of u is not uniform for light {light} at {query:?}: {outcome:?}",
                set.name
            );
        }
    }
}

/// Invalid contexts give a valid choice or `None`, and never a panic.
///
/// # Panics
/// If the law does not hold.
pub fn invalid_queries_do_not_panic(set: &SamplerCase, sampler: &impl LightSampler) {
    use crate::glam::Vec3;
    let mut contexts = Vec::new();
    for x in [f32::NAN, f32::INFINITY, f32::MAX, f32::from_bits(1)] {
        contexts.push(LightSampleContext::medium(Vec3::splat(x)));
        contexts.push(LightSampleContext::surface(
            Vec3::new(x, 0.0, 0.0),
            Vec3::Z,
            Vec3::Z,
        ));
        contexts.push(LightSampleContext::surface(
            Vec3::ZERO,
            Vec3::Z,
            Vec3::splat(x),
        ));
    }
    contexts.extend(set.contexts.first());
    for ctx in &contexts {
        for u in [0, 1 << 63, u64::MAX] {
            let chosen = sampler.sample(ctx, u);
            let known = chosen.is_none_or(|c| c.light.index() < set.emitters.len());
            assert!(
                known,
                "{}: {chosen:?} of an unknown light at u = {u}, {ctx:?}",
                set.name
            );
        }
        for id in set.ids() {
            let pmf = sampler.pmf(ctx, id);
            assert!(
                (0.0..=1.0).contains(&pmf),
                "{}: pmf {pmf} at {ctx:?}",
                set.name
            );
        }
    }
}
