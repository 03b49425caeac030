#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
// A kernel is built by an unstable compiler in any case, and has an instruction for roots.
#![cfg_attr(target_arch = "nvptx64", feature(core_float_math))]
#![cfg_attr(
    not(feature = "alloc"),
    allow(
        rustdoc::broken_intra_doc_links,
        reason = "links to what owns memory are plain text where it is left out"
    )
)]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("light-math needs float functions: turn on the feature `std` or the feature `libm`");

pub use glam;

mod aabb;
mod cone;
mod direction;
pub mod discrete;
pub mod distribution;
pub mod equal_area;
pub mod float;
pub mod fraction;
mod frame;
pub mod lat_long;
pub mod mis;
pub mod octahedral;
mod opposite;
pub mod quantize;
mod resample;
mod seen_triangle;
pub mod solid_angle;
pub mod spectrum;
mod sphere_image;
pub mod warp;

pub use aabb::Aabb;
pub use cone::DirectionCone;
pub use direction::direction;
pub use frame::Frame;
pub use octahedral::OctahedralVector;
pub use quantize::QuantizedBox;
pub use resample::Resampler;
pub use sphere_image::{SphereImage, SphereImageError, SphereMap};
