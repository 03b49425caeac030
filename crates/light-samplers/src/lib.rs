#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

#[cfg(feature = "alloc")]
extern crate alloc;

pub use light_bounds;
pub use light_bounds::SampledLight;

#[cfg(feature = "alloc")]
mod bvh;
#[cfg(feature = "alloc")]
mod bvh_cut;
#[cfg(feature = "alloc")]
mod exhaustive;
#[cfg(feature = "alloc")]
mod infinite;
mod light_look;
mod light_sampler;
#[cfg(feature = "alloc")]
mod power;
#[cfg(feature = "alloc")]
mod reference_bvh;
#[cfg(feature = "alloc")]
mod sky;
mod uniform;

#[cfg(feature = "alloc")]
pub use bvh::BvhLightSampler;
#[cfg(feature = "alloc")]
pub use bvh_cut::BvhLightCut;
#[cfg(feature = "alloc")]
pub use exhaustive::ExhaustiveLightSampler;
pub use light_look::LightLook;
pub use light_sampler::LightSampler;
#[cfg(feature = "alloc")]
pub use power::{PowerLightSampler, PowerLightSamplerError};
#[cfg(feature = "alloc")]
pub use reference_bvh::ReferenceBvhLightSampler;
pub use uniform::UniformLightSampler;
