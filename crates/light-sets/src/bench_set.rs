use light_bounds::LightExtent;

use crate::set_light::SetLight;
use crate::set_point::SetPoint;

/// Shading points of a generated set.
pub(crate) const POINTS: usize = 4096;

/// A set of lights, and the points at which a sampler is measured on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BenchSet {
    /// The lights; the index is the light's id.
    pub lights: Vec<SetLight>,
    /// The shading points.
    pub points: Vec<SetPoint>,
}

impl BenchSet {
    /// What samplers know of the lights, by id.
    #[must_use]
    pub fn extents(&self) -> Vec<LightExtent> {
        self.lights
            .iter()
            .map(|light| light.bounds().into())
            .collect()
    }

    /// The emitted powers of the lights, by id.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
    pub fn powers(&self) -> Vec<f32> {
        let powers = self.lights.iter().map(SetLight::power);
        powers.map(|power| power as f32).collect()
    }
}
