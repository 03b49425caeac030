use super::phase_function::PhaseFunction;
use core::f32::consts::PI;

/// Scatters equally in all directions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Isotropic;

impl PhaseFunction for Isotropic {
    #[inline]
    fn value(&self, _cos_theta: f32) -> f32 {
        0.25 / PI
    }

    #[inline]
    fn sample_cos(&self, u: f32) -> f32 {
        1.0 - 2.0 * u
    }
}
