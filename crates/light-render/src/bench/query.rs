use light_sets::{BenchSet, SetLight};
use lights::bounds::LightSampleContext;

use super::occluders::Occluders;
use super::receiver::BenchReceiver;
use super::variance_split::LightMoments;
use super::{BenchOptions, GroundTruth};

/// The query at the points of a set, with the exact contributions.
pub(super) struct Query {
    pub(super) receivers: Vec<BenchReceiver>,
    pub(super) contexts: Vec<LightSampleContext>,
    ground_truth: GroundTruth,
    occluders: Occluders,
}

impl Query {
    pub(super) fn new(set: &BenchSet, options: &BenchOptions) -> Self {
        let receivers: Vec<BenchReceiver> = (0..)
            .zip(&set.points)
            .map(|(index, &at)| options.receiver.receiver_at(index, at))
            .collect();
        Self {
            contexts: receivers.iter().map(|receiver| receiver.ctx).collect(),
            receivers,
            ground_truth: options.ground_truth,
            occluders: Occluders::among(set, options.occluders),
        }
    }

    /// The contribution of `light` at the receiver.
    pub(super) fn contribution(&self, light: &SetLight, receiver: &BenchReceiver) -> f64 {
        self.moments(light, receiver).mean
    }

    /// The contributions of the points of `light` to the receiver.
    pub(super) fn moments(&self, light: &SetLight, receiver: &BenchReceiver) -> LightMoments {
        let points = self.ground_truth.points(light);
        LightMoments::over(points.map(|p| {
            let f = light.contribution_from(p, receiver.at.p, 0.0, |wi| receiver.response(wi));
            if f > 0.0 && self.occluders.block(receiver.at.p.as_dvec3(), p) {
                [f, 0.0]
            } else {
                [f; 2]
            }
        }))
    }
}
