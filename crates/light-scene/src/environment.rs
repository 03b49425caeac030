use crate::ImageId;
use crate::glam::{Quat, Vec3};

/// A light that is no mesh, in the user's units.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SceneLight {
    /// Shines alike in all directions from one point.
    Point {
        /// Where.
        position: Vec3,
        /// Radiant intensity, in W sr^-1 per channel.
        intensity: Vec3,
    },
    /// Parallel light from infinitely far away.
    Distant {
        /// The unit direction in which the light travels.
        direction: Vec3,
        /// Irradiance on a plane that faces the light, in W m^-2 per channel.
        irradiance: Vec3,
    },
    /// The same radiance from every direction.
    UniformSky {
        /// In W m^-2 sr^-1 per channel.
        radiance: Vec3,
    },
    /// An image around the scene.
    ImageSky(SkyImage),
}

/// A lat-long image around the scene, seen from within.
///
/// Column u left to right, row v top to bottom, `t = pi v`, `p = 2 pi u`: direction (sin t sin p, cos t, -sin t cos p)
/// before the rotation; the middle of the map looks to +z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyImage {
    /// The image; its texels are radiance.
    pub image: ImageId,
    /// Multiplies every texel.
    pub scale: Vec3,
    /// From the map's directions to the world's.
    pub rotation: Quat,
}
