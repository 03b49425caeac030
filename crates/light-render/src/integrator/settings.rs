use core::num::NonZeroU32;

use lights::media::StepSize;

use super::Estimator;
use crate::World;

/// How paths are traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSettings {
    /// The number of segments of the longest path: 1 sees emitters directly, 2 adds direct light,
    /// and so on.
    pub max_depth: u32,
    /// How light is found.
    pub estimator: Estimator,
    /// How many lights are chosen at the first vertex where light samples can contribute, at most
    /// as many as there are. One of them gets a shadow ray. Later vertices, which count for less,
    /// choose one.
    pub light_samples: NonZeroU32,
    /// Where paths may scatter.
    pub integrator: Integrator,
}

impl PathSettings {
    /// Default number of lights chosen at the first diffuse vertex.
    ///
    /// More cost more than they gain: the remaining noise is that of shadows.
    pub const DEFAULT_LIGHT_SAMPLES: NonZeroU32 = NonZeroU32::new(2).unwrap();

    /// How many lights the first vertex chooses in `world`: more choices than lights repeat
    /// themselves.
    pub(super) fn first_choices(&self, world: &World) -> u32 {
        let lights = u32::try_from(world.lights().len()).unwrap_or(u32::MAX);
        self.light_samples.get().min(lights.max(1))
    }
}

/// How the light along a camera ray is found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Integrator {
    /// Paths from surface to surface; media are left out.
    #[default]
    Path,
    /// Paths that scatter in media as well.
    VolPath,
    /// Light that was scattered once.
    SingleScattering(SingleScattering),
}

impl Integrator {
    /// The integrator for `world`: [`VolPath`](Self::VolPath) if it has media.
    #[must_use]
    pub fn fitting(world: &World) -> Self {
        if world.has_media() {
            Self::VolPath
        } else {
            Self::Path
        }
    }
}

/// How the light that a medium scatters once is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SingleScattering {
    /// `light_samples` lights are chosen for the ray as a whole, each with a distance of its own.
    NextEvent,
    /// A march in steps of this length, one light a step: the classic integrator.
    Classic(StepSize),
}
