use lights::bounds::{LightId, LightSampleContext};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

use super::candidate::Candidate;

/// How many pmf queries the sums may take in all.
const SUM_BUDGET: usize = 4_000_000;

/// Samples at each point.
const SAMPLES: usize = 8;

/// How well a sampler obeys the laws.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Laws {
    /// Share of samples without a light.
    pub no_light: f64,
    /// Share of samples whose pmf has other bits than the queried one.
    pub pmf_mismatch: f64,
    /// Share of pmfs that are no number of `[0, 1]`.
    pub pmf_nan: f64,
    /// Largest excess over 1 of the sum of all lights' pmf at a point.
    pub pmf_sum_max_error: f64,
}

/// How far a sum may exceed 1 by rounding alone.
const ROUNDING: f64 = 1e-5;

impl Laws {
    /// Whether pmfs are probabilities, add up, and are those of the queries, to the bit.
    #[must_use]
    pub fn hold(&self) -> bool {
        self.pmf_mismatch == 0.0 && self.pmf_nan == 0.0 && self.pmf_sum_max_error <= ROUNDING
    }
}

/// Samples at all points, and sums at as many points as the query budget allows.
pub(super) fn check(candidate: &Candidate, contexts: &[LightSampleContext]) -> Laws {
    let sampler = candidate.sampler();
    let (mut none, mut mismatch, mut bad) = (0usize, 0usize, 0usize);
    let mut rng = Pcg64Mcg::seed_from_u64(0x1A35);
    for ctx in contexts {
        for _ in 0..SAMPLES {
            let Some(sample) = sampler.sample(ctx, rng.next_u64()) else {
                none += 1;
                continue;
            };
            let queried = sampler.pmf(ctx, sample.light);
            mismatch += usize::from(queried.to_bits() != sample.pmf.to_bits());
            bad += usize::from(!(sample.pmf > 0.0 && sample.pmf <= 1.0));
        }
    }
    let samples = (contexts.len() * SAMPLES) as f64;
    let lights = candidate.n_lights();
    let sum_points = (SUM_BUDGET / lights.max(1)).clamp(2, contexts.len().max(2));
    let sums: Vec<(f64, usize)> = contexts
        .par_iter()
        .take(sum_points)
        .map(|ctx| {
            let (mut sum, mut bad) = (0.0, 0);
            for id in 0..u32::try_from(lights).unwrap_or(u32::MAX) {
                let pmf = sampler.pmf(ctx, LightId(id));
                bad += usize::from(!(0.0..=1.0).contains(&pmf));
                sum += f64::from(pmf);
            }
            (sum, bad)
        })
        .collect();
    bad += sums.iter().map(|(_, bad)| bad).sum::<usize>();
    Laws {
        no_light: none as f64 / samples,
        pmf_mismatch: mismatch as f64 / samples,
        pmf_nan: bad as f64 / (samples + (sum_points * lights) as f64),
        pmf_sum_max_error: sums.iter().map(|(sum, _)| sum - 1.0).fold(0.0, f64::max),
    }
}
