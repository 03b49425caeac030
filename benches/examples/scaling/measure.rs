//! The costs of samplers over one set of lights.

use std::hint::black_box;

use light_render::{AnyLightSampler, SamplerKind};
use light_sets::{BenchSet, SetKind};
use light_testkit::Rng;
use lights::bounds::{LightExtent, LightId, LightSampleContext};
use lights::samplers::LightSampler;

use super::columns::{Costs, Measured, Row};
use benches::thread_time::{ThreadTimer, median, seconds_a_call};

/// The samplers, in the order of their rows.
const SAMPLERS: [SamplerKind; 4] = [
    SamplerKind::Bvh,
    SamplerKind::BvhReference,
    SamplerKind::Power,
    SamplerKind::Uniform,
];

/// Lights that the reference tree is built of at most: ten times as many take minutes.
const REFERENCE_LIGHTS: usize = 10_000_000;

const SET: SetKind = SetKind::Uniform;
const SEED: u64 = 1;

/// How carefully times are measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// Times that the median is of, at most.
    pub(super) rounds: u32,
    /// Seconds of processor time that one of them takes at least.
    pub(super) window: f64,
    /// Seconds after which a build or refit has no further round.
    enough: f64,
}

impl Effort {
    pub(super) const FULL: Self = Self {
        rounds: 5,
        window: 0.1,
        enough: 8.0,
    };

    /// For tests: figures are there, but rough.
    pub(super) const QUICK: Self = Self {
        rounds: 1,
        window: 0.002,
        enough: 0.0,
    };
}

/// A sampler and its times so far, seconds each.
struct Candidate {
    kind: SamplerKind,
    sampler: AnyLightSampler,
    builds: Vec<f64>,
    refits: Vec<f64>,
    samples: Vec<f64>,
    pmfs: Vec<f64>,
}

/// Bytes of memory that so many lights take at most while they are measured: with the reference tree
/// 246 each were, without it 172, and a sixth of room.
pub(super) const fn bytes(lights: usize) -> u64 {
    let bytes_a_light = if lights <= REFERENCE_LIGHTS { 288 } else { 200 };
    bytes_a_light * lights as u64
}

/// One row a sampler. They take turns, so that a slow spell of the machine hits all of them.
///
/// # Errors
/// A light that a sampler refuses.
pub(super) fn measure(
    lights: usize,
    effort: &Effort,
    progress: impl Fn(&str) + Sync,
) -> Result<Vec<Row>, String> {
    // Builds stay on the thread whose time is taken.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|e| format!("a thread for builds: {e}"))?;
    pool.install(|| {
        progress("lights");
        let set = BenchSet::generate(SET, lights, SEED);
        let extents = set.extents();
        let BenchSet {
            points,
            lights: list,
        } = set;
        drop(list);
        let contexts: Vec<LightSampleContext> = points
            .iter()
            .map(|at| LightSampleContext::surface(at.p, at.n, at.n))
            .collect();
        let mut candidates = Vec::new();
        for kind in SAMPLERS {
            if kind == SamplerKind::BvhReference && lights > REFERENCE_LIGHTS {
                continue;
            }
            progress(&format!("build of {kind}"));
            candidates.push(Candidate::new(kind, &extents, effort)?);
        }
        for _ in 0..effort.rounds {
            for candidate in &mut candidates {
                progress(&format!("build of {}", candidate.kind));
                candidate.build_again(&extents, effort)?;
            }
        }
        for _ in 0..effort.rounds {
            candidates
                .iter_mut()
                .try_for_each(|c| c.refit(&extents, effort))?;
        }
        for round in 0..effort.rounds {
            progress("queries");
            for candidate in &mut candidates {
                candidate.query(&contexts, effort.window, round);
            }
        }
        let rows = candidates.iter().map(|candidate| candidate.row(lights));
        Ok(rows.collect())
    })
}

fn build(kind: SamplerKind, extents: &[LightExtent]) -> Result<AnyLightSampler, String> {
    AnyLightSampler::over(kind, extents).map_err(|e| format!("{kind}: {e}"))
}

impl Candidate {
    /// The first build is a time too, if it is a long one.
    fn new(kind: SamplerKind, extents: &[LightExtent], effort: &Effort) -> Result<Self, String> {
        let timer = ThreadTimer::start();
        let sampler = build(kind, extents)?;
        let seconds = timer.seconds();
        let is_long = seconds >= effort.window;
        Ok(Self {
            kind,
            sampler,
            builds: is_long.then_some(seconds).into_iter().collect(),
            refits: Vec::new(),
            samples: Vec::new(),
            pmfs: Vec::new(),
        })
    }

    fn has_tree(&self) -> bool {
        matches!(self.kind, SamplerKind::Bvh | SamplerKind::BvhReference)
    }

    fn build_again(&mut self, extents: &[LightExtent], effort: &Effort) -> Result<(), String> {
        if self.has_tree() && self.builds.iter().sum::<f64>() <= effort.enough {
            let mut result = Ok(());
            self.builds.push(seconds_a_call(effort.window, || {
                if let Err(error) = build(self.kind, extents).map(black_box) {
                    result = Err(error);
                }
            }));
            return result;
        }
        Ok(())
    }

    fn refit(&mut self, extents: &[LightExtent], effort: &Effort) -> Result<(), String> {
        let AnyLightSampler::Bvh(sampler) = &mut self.sampler else {
            return Ok(());
        };
        let mut result = Ok(());
        self.refits.push(seconds_a_call(effort.window, || {
            if let Err(error) = sampler.refit(extents) {
                result = Err(format!("refit: {error}"));
            }
        }));
        result
    }

    fn query(&mut self, contexts: &[LightSampleContext], window: f64, round: u32) {
        let (sample, pmf) = seconds_a_query(&self.sampler, contexts, window, round);
        self.samples.push(sample);
        self.pmfs.extend(pmf);
    }

    fn row(&self, lights: usize) -> Row {
        let count = lights as f64;
        let nanoseconds = |seconds: &[f64]| Some(median(seconds)? * 1e9);
        let a_light = |seconds: &[f64]| Some(nanoseconds(seconds)? / count);
        Row {
            lights,
            sampler: Measured::Flat(self.kind),
            costs: Costs {
                build: a_light(&self.builds).filter(|_| self.has_tree()),
                refit: a_light(&self.refits),
                sample: nanoseconds(&self.samples),
                pmf: nanoseconds(&self.pmfs),
                bytes: Some(self.sampler.bytes(lights) as f64 / count),
            },
        }
    }
}

/// Seconds of a sample and of a pmf: every context once a call, each time with another random
/// number. No pmf where no light can be chosen.
pub(super) fn seconds_a_query(
    sampler: &impl LightSampler,
    contexts: &[LightSampleContext],
    window: f64,
    round: u32,
) -> (f64, Option<f64>) {
    let mut rng = Rng::new(100 + u64::from(round));
    let calls = contexts.len() as f64;
    let samples = seconds_a_call(window, || {
        for ctx in contexts {
            black_box(sampler.sample(ctx, rng.u64()));
        }
    });
    let chosen: Vec<(&LightSampleContext, LightId)> = contexts
        .iter()
        .cycle()
        .take(16 * contexts.len())
        .filter_map(|ctx| Some((ctx, sampler.sample(ctx, rng.u64())?.light)))
        .collect();
    let pmfs = (!chosen.is_empty()).then(|| {
        let pmfs = seconds_a_call(window, || {
            for (ctx, light) in &chosen {
                black_box(sampler.pmf(ctx, *light));
            }
        });
        pmfs / chosen.len() as f64
    });
    (samples / calls, pmfs)
}

#[cfg(test)]
mod tests {
    use super::super::columns::COLUMNS;
    use super::*;

    /// The titles of the columns that a sampler must have.
    fn titles(kind: SamplerKind) -> &'static [usize] {
        match kind {
            SamplerKind::Bvh => &[0, 1, 2, 3, 4],
            SamplerKind::BvhReference => &[0, 2, 3, 4],
            _ => &[2, 3, 4],
        }
    }

    #[test]
    fn no_column_is_missing() {
        for lights in [100, 1000, 10_000] {
            let rows = measure(lights, &Effort::QUICK, |_| {}).expect("valid lights");
            let samplers: Vec<Measured> = rows.iter().map(|row| row.sampler).collect();
            assert_eq!(samplers, SAMPLERS.map(Measured::Flat), "a row a sampler");
            for row in rows {
                let found = COLUMNS.iter().enumerate().filter(|(_, (_, cost))| {
                    cost(&row.costs).is_some_and(|x| x > 0.0 && x.is_finite())
                });
                let found: Vec<usize> = found.map(|(i, _)| i).collect();
                let Measured::Flat(kind) = row.sampler else {
                    panic!("{row:?} is placed");
                };
                assert_eq!(found, titles(kind), "{row:?}");
            }
        }
    }
}
