use lights::bounds::LightId;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

use super::candidate::Candidate;
use super::contributions::{Contributions, contributors};
use super::statistics::Summary;
use super::variance_split::{LightMoments, VarianceSplit};

/// Calls of `k` samples at all points together.
///
/// Where few points have most of the variance, as beside a lamp that is estimated too low, few calls
/// there do not tell whether several samples of a call are noisier than one.
const CALLS: usize = 1 << 18;

/// Calls that the variance at one of `points` is estimated from.
fn calls_at_each(points: usize) -> usize {
    (CALLS / points.max(1)).clamp(16, 1024)
}

/// Relative variance over the points that any light reaches; all numbers are NaN where there is no
/// such point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Variance {
    /// How many points any light reaches.
    pub lit_points: usize,
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
    /// The variance that no choice can remove; `None` for several samples a call, and where no
    /// point is lit. The fields above are the variance between lights alone.
    pub ceiling: Option<Ceiling>,
}

/// The least variance of one choice, mean over the points that any light reaches. Within a light
/// there is none if its ground truth is a single point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ceiling {
    /// Relative variance within lights, by the sampler.
    pub within: f64,
    /// Relative variance between and within lights, by the best choice there is.
    pub best: f64,
    /// The share of the contribution that is not occluded.
    pub arriving: f64,
}

struct AtPoint {
    total: f64,
    lost: f64,
    relative: f64,
    ceiling: Option<Ceiling>,
}

/// The variance of one sample, summed over all lights, at the first `points` receivers.
pub(super) fn exact(
    candidate: &Candidate,
    contributions: &impl Contributions,
    points: usize,
) -> Variance {
    let at_points = contributions.contexts()[..points]
        .par_iter()
        .enumerate()
        .map(|(receiver, ctx)| {
            let contributors: Vec<_> = contributors(contributions, receiver).collect();
            let mut is_seen = vec![false; contributions.lights()];
            for (id, light) in &contributors {
                is_seen[id.index()] = light.mean > 0.0;
            }
            let pmfs = candidate.pmfs(ctx, |id| is_seen[id.index()]);
            let pmf = |id: LightId| {
                if is_seen[id.index()] {
                    pmfs[id.index()]
                } else {
                    0.0
                }
            };
            let lights = contributors.into_iter();
            let lights: Vec<_> = lights.map(|(id, light)| (light, pmf(id).into())).collect();
            at_point(&lights)
        })
        .collect();
    summarise(at_points)
}

fn at_point(lights: &[(LightMoments, f64)]) -> AtPoint {
    let split = VarianceSplit::of(lights.iter().copied());
    let moments: Vec<LightMoments> = lights.iter().map(|(light, _)| *light).collect();
    let unoccluded: f64 = moments.iter().map(|light| light.unoccluded).sum();
    let relative = |variance: f64| variance / (split.total * split.total);
    AtPoint {
        total: split.total,
        lost: split.lost / split.total,
        relative: relative(split.between),
        ceiling: Some(Ceiling {
            within: relative(split.within),
            best: relative(VarianceSplit::best(&moments).sum()),
            arriving: split.total / unoccluded,
        }),
    }
}

/// `k` times the variance of the mean of `k` samples, from repeated calls at the first `points`
/// receivers.
pub(super) fn repeated(
    candidate: &Candidate,
    contributions: &impl Contributions,
    points: usize,
    k: u32,
) -> Variance {
    let calls = calls_at_each(points);
    let at_points = contributions.contexts()[..points]
        .par_iter()
        .enumerate()
        .map(|(i, ctx)| {
            let total: f64 = contributors(contributions, i)
                .map(|(_, light)| light.mean)
                .sum();
            let mut rng = Pcg64Mcg::seed_from_u64(i as u64);
            let mut squares = 0.0;
            let here = candidate.sampler().at(ctx, k);
            for _ in 0..calls {
                let mut mean = 0.0;
                for sample in here.samples(rng.next_u64()) {
                    let f = contributions.moments(i, sample.light).mean;
                    mean += f / f64::from(sample.pmf) / f64::from(k);
                }
                squares += (mean - total) * (mean - total) / calls as f64;
            }
            AtPoint {
                total,
                lost: 0.0,
                relative: f64::from(k) * squares / (total * total),
                ceiling: None,
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
    let count = lit.len() as f64;
    let summary = Summary::new(lit.iter().map(|v| v.relative).collect());
    let ceiling = lit.iter().map(|v| v.ceiling).sum::<Option<Ceiling>>();
    Variance {
        lit_points: lit.len(),
        mean: summary.mean,
        median: summary.median,
        p99: summary.p99,
        standard_error: summary.standard_error,
        flux_weighted: variances / squares,
        lost_energy: lost / count,
        ceiling: ceiling.filter(|_| !lit.is_empty()).map(|sum| sum / count),
    }
}

impl core::iter::Sum for Ceiling {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |a, b| Self {
            within: a.within + b.within,
            best: a.best + b.best,
            arriving: a.arriving + b.arriving,
        })
    }
}

impl core::ops::Div<f64> for Ceiling {
    type Output = Self;

    fn div(self, count: f64) -> Self {
        Self {
            within: self.within / count,
            best: self.best / count,
            arriving: self.arriving / count,
        }
    }
}
