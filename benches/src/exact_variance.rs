//! The variance of a choice of a light, without the noise of an estimate.

use light_testkit::light_sets::{SetLight, SetPoint};
use lights::bounds::LightSampleContext;
use lights::bvh::{InstancedLightBvh, LightBvh};

/// The exact relative variance at `point` of one choice among `lights`, each with its probability
/// `pmf`; `None` where no light arrives. Infinite where a light that arrives is never chosen.
fn exact_variance(
    lights: &[SetLight],
    point: &SetPoint,
    pmf: impl Fn(usize) -> f32,
) -> Option<f64> {
    let (mut squares, mut sum) = (0.0, 0.0);
    for (index, light) in lights.iter().enumerate() {
        let gives = light.contribution(point);
        if gives > 0.0 {
            squares += gives * gives / f64::from(pmf(index));
            sum += gives;
        }
    }
    (sum > 0.0).then(|| squares / (sum * sum) - 1.0)
}

/// The exact relative variance at `point` of one choice by `tree`, a tree of `lights`; `None` where
/// no light arrives.
#[must_use]
pub fn flat_variance(lights: &[SetLight], tree: &LightBvh, point: &SetPoint) -> Option<f64> {
    let ctx = LightSampleContext::surface(point.p, point.n, point.n);
    let mut pmfs = vec![0.0; lights.len()];
    tree.view()
        .for_each_pmf(&ctx, |light, pmf| pmfs[light.index()] = pmf);
    exact_variance(lights, point, |light| pmfs[light])
}

/// The same for a tree of placed trees.
#[must_use]
pub fn placed_variance(
    lights: &[SetLight],
    tree: &InstancedLightBvh,
    point: &SetPoint,
) -> Option<f64> {
    let at = tree.at(&LightSampleContext::surface(point.p, point.n, point.n));
    exact_variance(lights, point, |light| {
        let light = tree.light_of_index(light as u64);
        light.map_or(0.0, |light| at.pmf(light))
    })
}

/// Mean, median and largest of some variances.
#[must_use]
pub fn summary(mut variances: Vec<f64>) -> String {
    variances.sort_by(f64::total_cmp);
    let mean = variances.iter().sum::<f64>() / variances.len() as f64;
    let median = variances.get(variances.len() / 2).copied();
    let largest = variances.last().copied();
    let [median, largest] = [median, largest].map(Option::unwrap_or_default);
    format!("mean {mean:.3}, median {median:.3}, largest {largest:.2}")
}
