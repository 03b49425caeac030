use light_sets::BenchSet;

use super::{BenchReceiverKind, GroundTruth};
use crate::SamplerKind;

/// What to measure.
#[derive(Clone, Debug)]
pub struct BenchOptions {
    /// The samplers, in the order of the rows.
    pub samplers: Vec<SamplerKind>,
    /// Samples of one call.
    pub k: u32,
    /// How many of the set's points the variance is taken over; `None`: all of them up to 10
    /// thousand lights, 256 above.
    pub var_points: Option<usize>,
    /// Threads that build a tree and sum the variance. Queries are timed on one.
    pub threads: usize,
    /// What counts as the contribution of a light.
    pub ground_truth: GroundTruth,
    /// The kind of receiver.
    pub receiver: BenchReceiverKind,
    /// Occluding spheres, unknown to the samplers.
    pub occluders: usize,
}

impl Default for BenchOptions {
    /// One sample a call of a diffuse surface with nothing in the way, one thread, the samplers
    /// whose time does not grow with the lights.
    fn default() -> Self {
        Self {
            samplers: SamplerKind::SUBLINEAR.to_vec(),
            k: 1,
            var_points: None,
            threads: 1,
            ground_truth: GroundTruth::default(),
            receiver: BenchReceiverKind::default(),
            occluders: 0,
        }
    }
}

impl BenchOptions {
    /// How many points of the set its variance is taken over.
    pub(super) fn points_of(&self, set: &BenchSet) -> usize {
        let all = set.points.len();
        let few = if set.lights.len() > 10_000 { 256 } else { all };
        self.var_points.unwrap_or(few).min(all)
    }
}
