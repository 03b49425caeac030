use lights::bounds::LightExtent;

use super::build_time::build_time;
use super::candidate::Candidate;
use super::contributions::Contributions;
use super::measurement::Measurement;
use super::row::BenchRow;
use super::timing::QueryTime;
use super::{laws, timing, variance};
use crate::{AnyLightSamplerError, SamplerKind};

/// What is measured of samplers.
pub(super) struct Plan<'a> {
    /// The name in the rows.
    pub(super) set: &'a str,
    /// What is measured of them.
    pub(super) measurement: &'a Measurement,
    /// How many of the receivers the variance is taken over.
    pub(super) points: usize,
    /// The extents of the lights, for refits.
    pub(super) extents: &'a [LightExtent],
}

impl Plan<'_> {
    /// One row for each sampler, all measured in turns, so that their ratios are valid on a busy
    /// machine. `make` builds a sampler.
    ///
    /// # Errors
    /// The first light that a sampler refuses.
    ///
    /// # Panics
    /// If the system refuses to start the threads.
    pub(super) fn measure(
        &self,
        contributions: &impl Contributions,
        make: impl Fn(SamplerKind) -> Result<Candidate, AnyLightSamplerError> + Sync,
    ) -> Result<Vec<BenchRow>, AnyLightSamplerError> {
        let &Measurement {
            ref samplers,
            k,
            threads,
            is_timed,
            ..
        } = self.measurement;
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads for building");
        let built: Vec<(f64, Candidate)> = samplers
            .iter()
            .map(|&kind| {
                if !is_timed {
                    return Ok((0.0, pool.install(|| make(kind))?));
                }
                let (ms, candidate) = pool.install(|| build_time(|| make(kind)));
                Ok((ms, candidate?))
            })
            .collect::<Result<_, AnyLightSamplerError>>()?;
        let candidates: Vec<&Candidate> = built.iter().map(|(_, candidate)| candidate).collect();
        let contexts = contributions.contexts();
        let times = if is_timed {
            timing::queries(&candidates, contexts, k)
        } else {
            vec![QueryTime::default(); candidates.len()]
        };
        let rows = built
            .iter()
            .zip(times)
            .map(|((build_ms, candidate), time)| {
                let variance = pool.install(|| match k {
                    1 => variance::exact(candidate, contributions, self.points),
                    k => variance::repeated(candidate, contributions, self.points, k),
                });
                let refit_ms = || pool.install(|| candidate.refit_ms(self.extents));
                let laws = pool.install(|| laws::check(candidate, contexts));
                BenchRow {
                    set: self.set.to_owned(),
                    n_lights: contributions.lights(),
                    sampler: candidate.kind(),
                    k,
                    points: self.points,
                    build_ms: *build_ms,
                    refit_ms: is_timed.then(refit_ms).flatten(),
                    bytes: candidate.bytes(),
                    depth: candidate.depth(),
                    time,
                    variance,
                    laws,
                }
            })
            .collect();
        Ok(rows)
    }
}
