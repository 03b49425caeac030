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
mod first_choice;
#[cfg(feature = "alloc")]
mod infinite_lights;
#[cfg(feature = "alloc")]
mod infinite_shares;
mod light_sampler;
#[cfg(feature = "alloc")]
mod power;
mod prepared_choices;
#[cfg(feature = "alloc")]
mod reference_bvh;
mod uniform;

#[cfg(feature = "alloc")]
pub use bvh::BvhLightSampler;
#[cfg(feature = "alloc")]
pub use bvh_cut::BvhLightCut;
#[cfg(feature = "alloc")]
pub use exhaustive::ExhaustiveLightSampler;
pub use light_sampler::LightSampler;
#[cfg(feature = "alloc")]
pub use power::{PowerLightSampler, PowerLightSamplerError};
pub use prepared_choices::PreparedChoices;
#[cfg(feature = "alloc")]
pub use reference_bvh::ReferenceBvhLightSampler;
pub use uniform::UniformLightSampler;
