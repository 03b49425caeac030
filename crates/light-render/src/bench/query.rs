use light_sets::{BenchSet, SetLight};
use lights::bounds::{LightId, LightSampleContext};

use super::contributions::Contributions;
use super::occluders::Occluders;
use super::receiver::BenchReceiver;
use super::variance_split::LightMoments;
use super::{BenchOptions, GroundTruth};

/// The query at the points of a set, with the exact contributions.
pub(super) struct Query<'a> {
    set: &'a BenchSet,
    receivers: Vec<BenchReceiver>,
    contexts: Vec<LightSampleContext>,
    ground_truth: GroundTruth,
    occluders: Occluders,
}

impl<'a> Query<'a> {
    pub(super) fn new(set: &'a BenchSet, options: &BenchOptions) -> Self {
        let receivers: Vec<BenchReceiver> = (0..)
            .zip(&set.points)
            .map(|(index, &at)| options.receiver.receiver_at(index, at))
            .collect();
        Self {
            set,
            contexts: receivers.iter().map(|receiver| receiver.ctx).collect(),
            receivers,
            ground_truth: options.ground_truth,
            occluders: Occluders::among(set, options.occluders),
        }
    }

    /// The contributions of the points of `light` to the receiver.
    fn of_light(&self, light: &SetLight, receiver: &BenchReceiver) -> LightMoments {
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

impl Contributions for Query<'_> {
    fn contexts(&self) -> &[LightSampleContext] {
        &self.contexts
    }

    fn lights(&self) -> usize {
        self.set.lights.len()
    }

    fn moments(&self, receiver: usize, light: LightId) -> LightMoments {
        self.of_light(&self.set.lights[light.index()], &self.receivers[receiver])
    }
}
