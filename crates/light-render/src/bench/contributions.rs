use lights::bounds::{LightId, LightSampleContext};

use super::variance_split::LightMoments;

/// What every light gives to each of some receivers.
pub(super) trait Contributions: Sync {
    /// The receivers, as samplers are asked about them.
    fn contexts(&self) -> &[LightSampleContext];

    /// The number of lights.
    fn lights(&self) -> usize;

    /// What the points of a light give to the receiver of that index.
    fn moments(&self, receiver: usize, light: LightId) -> LightMoments;
}

/// All lights that could give something to a receiver if nothing were in the way, with what they
/// give.
pub(super) fn contributors(
    contributions: &impl Contributions,
    receiver: usize,
) -> impl Iterator<Item = (LightId, LightMoments)> {
    let lights = u32::try_from(contributions.lights()).unwrap_or(u32::MAX);
    let all = (0..lights).map(LightId);
    all.map(move |id| (id, contributions.moments(receiver, id)))
        .filter(|(_, light)| light.unoccluded > 0.0)
}
