use lights::bounds::{LightId, LightSampleContext};
use lights::glam::Vec2;

use super::contributions::Contributions;
use super::scene_receiver::{SceneReceiver, Shadows, points};
use super::variance_split::LightMoments;
use crate::World;

/// The lights of a scene at points of its surfaces.
pub(super) struct SceneQuery<'a> {
    world: &'a World,
    receivers: Vec<SceneReceiver>,
    contexts: Vec<LightSampleContext>,
    /// For each receiver the points of a light.
    points: Vec<Vec<Vec2>>,
    shadows: Shadows,
}

impl<'a> SceneQuery<'a> {
    /// With `strata` times `strata` points of each light.
    pub(super) fn new(
        world: &'a World,
        receivers: Vec<SceneReceiver>,
        strata: u16,
        shadows: Shadows,
    ) -> Self {
        let of_lights = |receiver: &SceneReceiver| points(strata, receiver.key);
        Self {
            world,
            contexts: receivers.iter().map(|receiver| receiver.ctx).collect(),
            points: receivers.iter().map(of_lights).collect(),
            receivers,
            shadows,
        }
    }
}

impl Contributions for SceneQuery<'_> {
    fn contexts(&self) -> &[LightSampleContext] {
        &self.contexts
    }

    fn lights(&self) -> usize {
        self.world.lights().len()
    }

    fn moments(&self, receiver: usize, light: LightId) -> LightMoments {
        let at = &self.receivers[receiver];
        let points = self.points[receiver].iter();
        LightMoments::over(points.map(|&u| at.gives(self.world, light, u, self.shadows)))
    }
}
