use light_sets::BenchSet;
use lights::bounds::LightId;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

use super::candidate::Candidate;
use super::query::Query;
use super::statistics::Summary;

/// Calls of `k` samples that the variance at one point is estimated from.
const CALLS: usize = 16;

/// Relative variance over the points that any light reaches.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Variance {
    /// Mean over the points.
    pub mean: f64,
    /// Median over the points.
    pub median: f64,
    /// 99th percentile over the points.
    pub p99: f64,
    /// Standard error of the mean: of the choice of points, and of the calls if there were several
    /// samples a call.
    pub standard_error: f64,
    /// Sum over the points of the variances over the sum of the squared contributions: weighted as
    /// a picture weighs it.
    pub flux_weighted: f64,
    /// Share of the contribution, mean over the points, in lights of probability 0.
    pub lost_energy: f64,
}

struct AtPoint {
    total: f64,
    lost: f64,
    relative: f64,
}

/// The variance of one sample, summed over all lights.
pub(super) fn exact(
    candidate: &Candidate,
    set: &BenchSet,
    query: &Query,
    points: usize,
) -> Variance {
    let at_points = query.receivers[..points]
        .par_iter()
        .map(|receiver| {
            let (mut total, mut reached, mut second_moment) = (0.0, 0.0, 0.0);
            for (id, light) in (0u32..).zip(&set.lights) {
                let f = query.contribution(light, receiver);
                if f <= 0.0 {
                    continue;
                }
                total += f;
                let pmf = f64::from(candidate.sampler().pmf(&receiver.ctx, LightId(id)));
                if pmf > 0.0 {
                    reached += f;
                    second_moment += f * f / pmf;
                }
            }
            AtPoint {
                total,
                lost: (total - reached) / total,
                relative: (second_moment - reached * reached) / (total * total),
            }
        })
        .collect();
    summarise(at_points)
}

/// `k` times the variance of the mean of `k` samples, from repeated calls.
pub(super) fn repeated(
    candidate: &Candidate,
    set: &BenchSet,
    query: &Query,
    points: usize,
    k: u32,
) -> Variance {
    let at_points = query.receivers[..points]
        .par_iter()
        .enumerate()
        .map(|(i, receiver)| {
            let total: f64 = set
                .lights
                .iter()
                .map(|light| query.contribution(light, receiver))
                .sum();
            let mut rng = Pcg64Mcg::seed_from_u64(i as u64);
            let mut squares = 0.0;
            let here = candidate.sampler().at(&receiver.ctx, k);
            for _ in 0..CALLS {
                let mut mean = 0.0;
                for sample in here.samples(rng.next_u64()) {
                    let f = query.contribution(&set.lights[sample.light.index()], receiver);
                    mean += f / f64::from(sample.pmf) / f64::from(k);
                }
                squares += (mean - total) * (mean - total) / CALLS as f64;
            }
            AtPoint {
                total,
                lost: 0.0,
                relative: f64::from(k) * squares / (total * total),
            }
        })
        .collect();
    summarise(at_points)
}

fn summarise(at_points: Vec<AtPoint>) -> Variance {
    let lit: Vec<AtPoint> = at_points.into_iter().filter(|v| v.total > 0.0).collect();
    let squares: f64 = lit.iter().map(|v| v.total * v.total).sum();
    let variances: f64 = lit.iter().map(|v| v.relative * v.total * v.total).sum();
    let lost: f64 = lit.iter().map(|v| v.lost).sum();
    let count = lit.len().max(1) as f64;
    let summary = Summary::new(lit.iter().map(|v| v.relative).collect());
    Variance {
        mean: summary.mean,
        median: summary.median,
        p99: summary.p99,
        standard_error: summary.standard_error,
        flux_weighted: if squares > 0.0 {
            variances / squares
        } else {
            0.0
        },
        lost_energy: lost / count,
    }
}
