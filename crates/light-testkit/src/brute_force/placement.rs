use light_math::glam::{Affine3A, Mat3, Quat, Vec3};
use light_sources::SceneSphere;

use crate::Rng;

/// Where a light of about unit size is: its unit of length, its distance from the origin, its
/// rotation, and whether it is mirrored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    /// Length of what is 1 in the light's description.
    pub(super) unit: f32,
    /// In units of `unit`: 0, or up to ten thousand times the size.
    pub(super) offset: Vec3,
    /// Rigid, without a translation.
    pub(super) turn: Mat3,
}

impl Placement {
    pub(super) fn random(rng: &mut Rng) -> Self {
        let distance = match rng.below(3) {
            0 => 0.0,
            _ => rng.log_range(0.1, 1e4),
        };
        let turn = match rng.below(4) {
            0 => Mat3::IDENTITY,
            _ => Mat3::from_quat(Quat::from_axis_angle(rng.direction(), rng.range(0.0, 6.3))),
        };
        let mirror = match rng.below(4) {
            0 => Vec3::new(-1.0, 1.0, 1.0),
            1 => Vec3::new(1.0, 1.0, -1.0),
            _ => Vec3::ONE,
        };
        Self {
            unit: [1.0, rng.log_range(1e-3, 1e3)][rng.below(2)],
            offset: rng.direction() * distance,
            turn: turn * Mat3::from_diagonal(mirror),
        }
    }

    /// The point that the description calls `p`.
    pub(super) fn point(&self, p: Vec3) -> Vec3 {
        (self.turn * p + self.offset) * self.unit
    }

    /// The rigid transform around the light.
    pub(super) fn transform(&self) -> Affine3A {
        Affine3A::from_mat3_translation(self.turn, self.offset * self.unit)
    }
}

/// The scene of lights that it does not matter to.
pub(super) fn any_scene() -> SceneSphere {
    SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere")
}
