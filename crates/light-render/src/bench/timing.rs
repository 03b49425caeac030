use core::hint::black_box;
use core::time::Duration;
use std::time::Instant;

use lights::bounds::{LightId, LightSampleContext};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::subject::Subject;

/// Passes over all points that every sampler gets at least, and how long to go on.
const MIN_PASSES: usize = 9;
const TIME_PER_SUBJECT: Duration = Duration::from_millis(600);

/// Nanoseconds a query: the fastest of many passes, which a busy machine disturbs least.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct QueryTime {
    /// One sample, or one of the `k` samples of a call.
    pub sample: f64,
    /// The pmf of a light that the sampler itself picked at the point, as multiple importance sampling asks it.
    pub pmf: f64,
    /// The pmf of a light picked at random.
    pub pmf_random_light: f64,
}

/// Milliseconds of the fastest of several builds, and what was built.
pub(super) fn build<T>(make: impl FnMut() -> T) -> (f64, T) {
    let (begin, mut make) = (Instant::now(), make);
    let mut best = f64::INFINITY;
    loop {
        let start = Instant::now();
        let built = make();
        best = best.min(start.elapsed().as_secs_f64() * 1e3);
        if begin.elapsed() > TIME_PER_SUBJECT {
            return (best, built);
        }
    }
}

/// The time of each subject's queries. They take turns, so that a slow spell of the machine hits all of them.
pub(super) fn queries(
    subjects: &[&Subject],
    contexts: &[LightSampleContext],
    k: u32,
) -> Vec<QueryTime> {
    let mut rng = Pcg64Mcg::seed_from_u64(0x7131);
    let us: Vec<f64> = contexts.iter().map(|_| unit(&mut rng)).collect();
    let plans: Vec<Plan> = subjects
        .iter()
        .map(|subject| Plan::new(subject, contexts, &us, &mut rng))
        .collect();
    let mut times = vec![
        QueryTime {
            sample: f64::INFINITY,
            pmf: f64::INFINITY,
            pmf_random_light: f64::INFINITY,
        };
        subjects.len()
    ];
    let begin = Instant::now();
    let limit = TIME_PER_SUBJECT * u32::try_from(subjects.len()).unwrap_or(u32::MAX);
    let mut passes = 0;
    while passes < MIN_PASSES || begin.elapsed() < limit {
        passes += 1;
        for ((subject, plan), time) in subjects.iter().zip(&plans).zip(&mut times) {
            let sample = per_call(contexts.len() * k as usize, || {
                if k == 1 {
                    for (ctx, &u) in contexts.iter().zip(&us) {
                        black_box(subject.sampler().sample(ctx, u));
                    }
                } else {
                    for (ctx, &u) in contexts.iter().zip(&us) {
                        subject.sampler().sample_many(ctx, u, k, &mut |sample| {
                            black_box(sample);
                        });
                    }
                }
            });
            let pmf = |queries: &[(LightSampleContext, LightId)]| {
                per_call(queries.len(), || {
                    for (ctx, light) in queries {
                        black_box(match k {
                            1 => subject.sampler().pmf(ctx, *light),
                            _ => subject.sampler().pmf_many(ctx, *light),
                        });
                    }
                })
            };
            time.sample = time.sample.min(sample);
            time.pmf = time.pmf.min(pmf(&plan.picked));
            time.pmf_random_light = time.pmf_random_light.min(pmf(&plan.random));
        }
    }
    times
}

/// Uniform in `[0, 1)` with 53 bits.
pub(super) fn unit(rng: &mut Pcg64Mcg) -> f64 {
    (rng.next_u64() >> 11) as f64 / 9_007_199_254_740_992.0
}

/// Which pmfs are asked.
struct Plan {
    picked: Vec<(LightSampleContext, LightId)>,
    random: Vec<(LightSampleContext, LightId)>,
}

impl Plan {
    fn new(
        subject: &Subject,
        contexts: &[LightSampleContext],
        us: &[f64],
        rng: &mut Pcg64Mcg,
    ) -> Self {
        let lights = u64::try_from(subject.n_lights().max(1)).unwrap_or(u64::MAX);
        let picked = contexts
            .iter()
            .zip(us)
            .filter_map(|(ctx, &u)| Some((*ctx, subject.sampler().sample(ctx, u)?.light)))
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

/// Nanoseconds that one of `calls` takes.
fn per_call(calls: usize, pass: impl FnOnce()) -> f64 {
    let start = Instant::now();
    pass();
    start.elapsed().as_secs_f64() * 1e9 / calls.max(1) as f64
}
