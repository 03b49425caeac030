use light_sets::BenchSet;

use super::{BenchReceiverKind, GroundTruth, Measurement};

/// How samplers are measured on a set of lights. By default of diffuse surfaces with nothing in the
/// way.
#[derive(Clone, Debug, Default)]
pub struct BenchOptions {
    /// What is measured. Without a number of its own the variance is taken over all points of the
    /// set up to 10 thousand lights, over 256 above.
    pub measurement: Measurement,
    /// What counts as the contribution of a light.
    pub ground_truth: GroundTruth,
    /// The kind of receiver.
    pub receiver: BenchReceiverKind,
    /// Occluding spheres, unknown to the samplers.
    pub occluders: usize,
}

impl BenchOptions {
    /// How many points of the set its variance is taken over.
    pub(super) fn points_of(&self, set: &BenchSet) -> usize {
        let all = set.points.len();
        let few = if set.lights.len() > 10_000 { 256 } else { all };
        self.measurement.var_points.unwrap_or(few).min(all)
    }
}
