use super::deflection::Deflection;
use light_math::glam::Vec3;

/// A phase function that depends on the angle of deflection alone.
///
/// `cos_theta` is the cosine between the directions of travel before and after the event: 1 is
/// straight on, -1 straight back. For directions `wo` and
/// `wi` that both point away from the event it is `-dot(wo, wi)`. Every phase function here is
/// sampled exactly, so its density is its value.
pub trait PhaseFunction {
    /// The phase function per steradian; integrates to one over the sphere.
    fn value(&self, cos_theta: f32) -> f32;

    /// A cosine of deflection in `[-1, 1]` with density `TAU * value`, from `u` in `[0, 1)`.
    fn sample_cos(&self, u: f32) -> f32;

    /// The value for a deflection. The default takes its cosine; a narrow peak needs its sine.
    #[inline]
    fn value_at(&self, deflection: Deflection) -> f32 {
        self.value(deflection.cos_theta)
    }

    /// The deflection with the cosine of [`sample_cos`](Self::sample_cos). A narrow peak has digits
    /// in the sine that the cosine lacks.
    #[inline]
    fn sample_deflection(&self, u: f32) -> Deflection {
        Deflection::from_cos(self.sample_cos(u))
    }
}

/// A direction chosen by a phase function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhaseSample {
    /// Unit direction toward which the path goes on.
    pub wi: Vec3,
    /// Its density per steradian, which is also the phase function's value.
    pub pdf: f32,
}
