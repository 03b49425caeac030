use lights::glam::Vec3;

/// What one path found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Traced {
    /// Radiance that arrives along the first ray.
    pub radiance: Vec3,
    /// How many rays were asked for, shadow rays included.
    pub rays: u32,
}
