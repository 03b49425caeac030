//! One choice by a cut through the default tree.

use light_render::bench::{LightMoments, VarianceSplit};
use light_sets::BenchSet;
use lights::bounds::{LightId, LightSampleContext};
use lights::bvh::{CutDetail, LightBvh, LightCut};
use rayon::prelude::*;

/// Means over the points that any light reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ByCut {
    /// Relative variance of one choice.
    pub(super) variance: f64,
    /// Nodes of the cut.
    pub(super) nodes: f64,
}

/// By cuts of the default detail, at all points of the set.
///
/// # Errors
/// A light that the tree refuses, or one that a cut loses.
pub(super) fn by_cut(set: &BenchSet) -> Result<ByCut, String> {
    let tree = LightBvh::build(&set.extents()).map_err(|e| e.to_string())?;
    let at_points: Vec<(VarianceSplit, usize)> = set
        .points
        .par_iter()
        .map(|point| {
            let ctx = LightSampleContext::surface(point.p, point.n, point.n);
            let cut = tree.view().cut(&ctx, CutDetail::default());
            let contributions = set.lights.iter().map(|light| light.contribution(point));
            (split(&cut, contributions), cut.node_count())
        })
        .filter(|(split, _)| split.total > 0.0)
        .collect();
    if let Some((split, _)) = at_points.iter().find(|(split, _)| split.lost > 0.0) {
        return Err(format!("a cut loses lights: {split:?}"));
    }
    let count = at_points.len().max(1) as f64;
    let variances = at_points
        .iter()
        .map(|(split, _)| split.between / (split.total * split.total));
    let nodes: usize = at_points.iter().map(|(_, nodes)| nodes).sum();
    Ok(ByCut {
        variance: variances.sum::<f64>() / count,
        nodes: nodes as f64 / count,
    })
}

/// The variance of one choice among lights of these contributions.
fn split(cut: &LightCut<'_>, contributions: impl Iterator<Item = f64>) -> VarianceSplit {
    let ids = (0..).map(LightId);
    VarianceSplit::of(
        ids.zip(contributions)
            .filter(|&(_, mean)| mean > 0.0)
            .map(|(id, mean)| {
                let light = LightMoments {
                    mean,
                    square: mean * mean,
                    unoccluded: mean,
                };
                (light, cut.pmf(id).into())
            }),
    )
}

#[cfg(test)]
mod tests {
    use light_sets::SetKind;

    use super::*;

    /// A set that is one node has no other choices by its cut.
    #[test]
    fn the_cut_of_one_node_is_the_tree() {
        let mut set = BenchSet::generate(SetKind::Uniform, 12, 1);
        set.points.truncate(20);
        let tree = LightBvh::build(&set.extents()).expect("valid lights");
        let mut variances = Vec::new();
        for point in &set.points {
            let ctx = LightSampleContext::surface(point.p, point.n, point.n);
            let lights = set.lights.iter().zip((0..).map(LightId));
            let lights = lights.map(|(light, id)| (light.contribution(point), tree.pmf(&ctx, id)));
            let (mut total, mut squares) = (0.0, 0.0);
            for (f, pmf) in lights.filter(|(f, _)| *f > 0.0) {
                total += f;
                squares += f * f / f64::from(pmf);
            }
            if total > 0.0 {
                variances.push(squares / (total * total) - 1.0);
            }
        }
        let variance = variances.iter().sum::<f64>() / variances.len() as f64;
        let found = by_cut(&set).expect("no light is lost");
        assert_eq!(found.nodes, 1.0);
        assert!(
            (found.variance - variance).abs() < 1e-9,
            "{found:?}, {variance}"
        );
    }
}
