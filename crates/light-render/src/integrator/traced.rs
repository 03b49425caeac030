use lights::glam::Vec3;

/// The result of one path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Traced {
    /// Radiance that arrives along the first ray.
    pub radiance: Vec3,
    /// The number of rays traced, shadow rays included.
    pub rays: u32,
}
