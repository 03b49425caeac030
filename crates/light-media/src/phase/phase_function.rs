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
}

/// A direction chosen by a phase function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhaseSample {
    /// Unit direction toward which the path goes on.
    pub wi: Vec3,
    /// Its density per steradian, which is also the phase function's value.
    pub pdf: f32,
}
