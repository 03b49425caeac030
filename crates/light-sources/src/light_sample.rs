use crate::glam::{Vec2, Vec3};

/// A sample of the light that arrives at a point: the result of
/// [`Light::sample_li`](crate::Light::sample_li).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightLiSample<R> {
    /// Arriving radiance in W m^-2 sr^-1; for a light at a point its intensity over the squared
    /// distance, for one from a single direction its irradiance. Without
    /// visibility, which the caller tests.
    pub l: R,
    /// Unit direction toward the light.
    pub wi: Vec3,
    /// Density of `wi` in sr^-1, never 0; 1 for lights in one point or one direction.
    pub pdf: f32,
    /// The point on the light, where a shadow ray ends. For a light at infinity a point outside of
    /// the scene.
    pub p_light: Vec3,
    /// Unit geometric normal at `p_light`, of the front side; zero for lights without a surface.
    pub n_light: Vec3,
    /// Surface parameters at `p_light`; for an environment map, the point of the map.
    pub uv: Vec2,
}

/// The ray of an emission sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittedRay {
    /// Start, in scene units.
    pub origin: Vec3,
    /// Unit direction of travel.
    pub direction: Vec3,
    /// Unit geometric normal of the front side at the origin; zero for lights without a surface.
    pub normal: Vec3,
    /// Surface parameters at the origin.
    pub uv: Vec2,
}

impl EmittedRay {
    /// A ray that leaves a point rather than a surface.
    #[must_use]
    pub const fn from_point(origin: Vec3, direction: Vec3) -> Self {
        Self {
            origin,
            direction,
            normal: Vec3::ZERO,
            uv: Vec2::ZERO,
        }
    }
}

/// A sample of the emission of a light: the result of
/// [`Light::sample_le`](crate::Light::sample_le).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightLeSample<R> {
    /// Emitted radiance along the ray; for a light at a point its intensity, for one from a single
    /// direction its irradiance. [`Light::sample_le`](crate::Light::sample_le) says how it is
    /// weighted.
    pub l: R,
    /// The ray.
    pub ray: EmittedRay,
    /// Densities of the ray, where a Dirac counts as 1.
    pub pdf: LePdf,
}

/// Densities of a ray that leaves a light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LePdf {
    /// Density of the origin per area, in length^-2.
    pub pos: f32,
    /// Density of the direction, in sr^-1.
    pub dir: f32,
}
