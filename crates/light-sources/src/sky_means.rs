use crate::glam::Vec3;

/// What is known of a picture of the sky as a whole, by solid angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SkyMeans {
    /// The mean colour.
    pub(crate) color: Vec3,
    /// The mean over the channels, too, by which directions are chosen.
    pub(crate) average: f32,
    /// The mean direction toward the light, in light space; the shorter, the wider it is spread.
    pub(crate) direction: Vec3,
}
