#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]

pub use light_bounds as bounds;
pub use light_bvh as bvh;
pub use light_math as math;
pub use light_math::glam;
pub use light_media as media;
pub use light_samplers as samplers;
pub use light_sources as sources;
