#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

pub use light_bounds;
pub use light_bounds::SampledLight;

mod light_sampler;
mod uniform;

pub use light_sampler::LightSampler;
pub use uniform::UniformLightSampler;
