use core::hint::black_box;
use std::time::Instant;

use lights::bounds::{LightId, LightSampleContext};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::candidate::Candidate;
use super::repetition::TIME_PER_MEASUREMENT;

/// Passes over all points that every sampler gets at least.
const MIN_PASSES: usize = 9;

/// Increment of `u` between passes: the fraction of the golden ratio, which keeps passes apart.
const TURN: u64 = 0x9e37_79b9_7f4a_7c15;

/// Queries that are timed together.
const RUN: usize = 64;

/// Nanoseconds a query: the fastest of many passes, in short runs, which a busy machine disturbs
/// least.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct QueryTime {
    /// One sample, or one of the `k` samples of a call.
    pub sample: f64,
    /// The pmf of a light that the sampler itself picked at the point, as multiple importance
    /// sampling asks it; NaN if it picks none at any point.
    pub pmf: f64,
    /// The pmf of a light picked at random.
    pub pmf_random_light: f64,
}

/// The time of each candidate's queries. They take turns, so that a slow spell of the machine hits
/// all of them.
pub(super) fn queries(
    candidates: &[&Candidate],
    contexts: &[LightSampleContext],
    k: u32,
) -> Vec<QueryTime> {
    let mut rng = Pcg64Mcg::seed_from_u64(0x7131);
    let mut us: Vec<u64> = contexts.iter().map(|_| rng.next_u64()).collect();
    let plans: Vec<Plan> = candidates
        .iter()
        .map(|candidate| Plan::new(candidate, contexts, &us, &mut rng))
        .collect();
    let mut times = vec![Times::default(); candidates.len()];
    let begin = Instant::now();
    let limit = TIME_PER_MEASUREMENT * u32::try_from(candidates.len()).unwrap_or(u32::MAX);
    let mut passes = 0;
    while passes < MIN_PASSES || begin.elapsed() < limit {
        passes += 1;
        // Each pass uses other `u`, so that the caches do not hold the nodes of the last one.
        us.iter_mut().for_each(|u| *u = u.wrapping_add(TURN));
        for ((candidate, plan), time) in candidates.iter().zip(&plans).zip(&mut times) {
            let asked: Vec<_> = contexts.iter().zip(&us).collect();
            time.sample.pass(&asked, |(ctx, u)| {
                if k == 1 {
                    black_box(candidate.sampler().sample(ctx, **u));
                } else {
                    for sample in candidate.sampler().at(ctx, k).samples(**u) {
                        black_box(sample);
                    }
                }
            });
            let pmf = |(ctx, light): &(LightSampleContext, LightId)| {
                black_box(match k {
                    1 => candidate.sampler().pmf(ctx, *light),
                    _ => candidate.sampler().at(ctx, k).pmf(*light),
                });
            };
            time.pmf.pass(&plan.picked, pmf);
            time.pmf_random_light.pass(&plan.random, pmf);
        }
    }
    times
        .iter()
        .map(|time| QueryTime {
            sample: time.sample.per_query() / f64::from(k),
            pmf: time.pmf.per_query(),
            pmf_random_light: time.pmf_random_light.per_query(),
        })
        .collect()
}

/// The times of the three queries of a sampler.
#[derive(Clone, Default)]
struct Times {
    sample: Fastest,
    pmf: Fastest,
    pmf_random_light: Fastest,
}

/// The time of many queries, as the sum of the fastest times of short runs of them: a run is over
/// before a busy machine takes the processor away, if not in this pass then in another.
#[derive(Clone, Default)]
struct Fastest {
    seconds: Vec<f64>,
    queries: usize,
}

impl Fastest {
    /// Runs all `queries` once, and keeps the fastest times so far.
    fn pass<T>(&mut self, queries: &[T], mut ask: impl FnMut(&T)) {
        self.queries = queries.len();
        self.seconds
            .resize(queries.len().div_ceil(RUN), f64::INFINITY);
        for (run, fastest) in queries.chunks(RUN).zip(&mut self.seconds) {
            let start = Instant::now();
            run.iter().for_each(&mut ask);
            *fastest = fastest.min(start.elapsed().as_secs_f64());
        }
    }

    /// Nanoseconds a query; NaN without a query.
    fn per_query(&self) -> f64 {
        self.seconds.iter().sum::<f64>() * 1e9 / self.queries as f64
    }
}

/// The kind of pmf query.
struct Plan {
    picked: Vec<(LightSampleContext, LightId)>,
    random: Vec<(LightSampleContext, LightId)>,
}

impl Plan {
    fn new(
        candidate: &Candidate,
        contexts: &[LightSampleContext],
        us: &[u64],
        rng: &mut Pcg64Mcg,
    ) -> Self {
        let lights = u64::try_from(candidate.n_lights().max(1)).unwrap_or(u64::MAX);
        let picked = contexts
            .iter()
            .zip(us)
            .filter_map(|(ctx, &u)| Some((*ctx, candidate.sampler().sample(ctx, u)?.light)))
            .collect();
        let random = contexts
            .iter()
            .map(|ctx| {
                let id = u32::try_from(rng.next_u64() % lights).unwrap_or(0);
                (*ctx, LightId(id))
            })
            .collect();
        Self { picked, random }
    }
}
