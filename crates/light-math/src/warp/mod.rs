//! Maps from uniform random numbers to densities, each with its density and its inverse.
//!
//! Every module holds the trio `sample`, `pdf`, `invert`; a shape with a costly set-up is a
//! type with methods of these names. Random numbers `u` are in `[0, 1)`; a
//! sample never has zero density, at both ends of that range too. Maps compose: the inverse of one
//! feeds another, so that for example the corners of the square may be weighted by [`bilinear`]
//! before they go through any other map.

pub mod bilinear;
#[doc(alias = "uniform_disk")]
pub mod concentric_disk;
pub mod cosine_hemisphere;
mod equiangular;
pub mod linear;
pub mod polar_disk;
pub mod smoothstep;
mod spherical_rectangle;
mod spherical_triangle;
pub mod uniform_cone;
pub mod uniform_hemisphere;
pub mod uniform_sphere;
pub mod uniform_triangle;

pub use equiangular::Equiangular;
pub use spherical_rectangle::SphericalRectangle;
pub use spherical_triangle::SphericalTriangle;

use crate::float::{atan2, sin_cos};
use core::f32::consts::TAU;
use glam::Vec2;

/// The numbers of the maps above, by name, for ports of them to another language.
pub const WARP_CONSTANTS: [(&str, f32); 3] = [
    ("NEGLIGIBLE", linear::NEGLIGIBLE),
    ("NEWTON_PRECISION", spherical_rectangle::NEWTON_PRECISION),
    ("NEWTON_REACH", spherical_rectangle::NEWTON_REACH),
];

/// The unit vector at the azimuth `u * 2 pi`.
fn azimuth(u: f32) -> Vec2 {
    let (sin_phi, cos_phi) = sin_cos(TAU * u);
    Vec2::new(cos_phi, sin_phi)
}

/// The `u` in `[0, 1]` of the azimuth of `(x, y)`; 0 at the pole.
fn invert_azimuth(x: f32, y: f32) -> f32 {
    let phi = atan2(y, x);
    (if phi < 0.0 { phi + TAU } else { phi }) / TAU
}
