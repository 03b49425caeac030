use light_sets::{BenchSet, SetLight};
use lights::bounds::LightSampleContext;

use super::occluders::Occluders;
use super::receiver::Asker;
use super::{BenchOptions, GroundTruth};

/// The query at the points of a set, with the exact contributions.
pub(super) struct Query {
    pub(super) askers: Vec<Asker>,
    pub(super) contexts: Vec<LightSampleContext>,
    ground_truth: GroundTruth,
    occluders: Occluders,
}

impl Query {
    pub(super) fn new(set: &BenchSet, options: &BenchOptions) -> Self {
        let askers: Vec<Asker> = (0..)
            .zip(&set.points)
            .map(|(index, &at)| options.receiver.asker(index, at))
            .collect();
        Self {
            contexts: askers.iter().map(|asker| asker.ctx).collect(),
            askers,
            ground_truth: options.ground_truth,
            occluders: Occluders::among(set, options.occluders),
        }
    }

    /// The contribution of `light` at the receiver.
    pub(super) fn contribution(&self, light: &SetLight, asker: &Asker) -> f64 {
        let points = self.ground_truth.points(light);
        let count = points.len() as f64;
        let sum: f64 = points
            .map(|p| {
                let f = light.contribution_from(p, asker.at.p, 0.0, |wi| asker.response(wi));
                if f > 0.0 && self.occluders.block(asker.at.p.as_dvec3(), p) {
                    0.0
                } else {
                    f
                }
            })
            .sum();
        sum / count
    }
}
