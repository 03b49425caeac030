#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
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

pub use light_bounds;
pub use light_bounds::SampledLight;
pub use light_bounds::glam;
pub use light_bounds::light_math;
pub use light_bvh;

#[cfg(feature = "alloc")]
mod bvh;
mod bvh_choices;
mod bvh_ref;
#[cfg(feature = "alloc")]
mod exhaustive;
mod first_choice;
mod grouped;
#[cfg(feature = "alloc")]
mod id_count;
mod infinite_lights;
#[cfg(feature = "alloc")]
mod infinite_shares;
#[cfg(feature = "alloc")]
mod instanced;
mod light_sampler;
#[cfg(feature = "alloc")]
mod placed_lights_at;
#[cfg(feature = "alloc")]
mod power;
#[cfg(feature = "alloc")]
mod reference_bvh;
mod resampled;
mod uniform;
mod visibility;

#[cfg(feature = "alloc")]
pub use bvh::BvhLightSampler;
pub use bvh_ref::BvhLightSamplerRef;
#[cfg(feature = "alloc")]
pub use exhaustive::ExhaustiveLightSampler;
pub use grouped::GroupedLightSampler;
pub use infinite_lights::{HORIZON_SLACK, InfiniteLightsError, StoredInfiniteLight};
#[cfg(feature = "alloc")]
pub use instanced::{InstancedBvhLightSampler, InstancedBvhLightSamplerError};
pub use light_sampler::{LightChoices, LightSampler};
#[cfg(feature = "alloc")]
pub use power::{PowerLightSampler, PowerLightSamplerError};
#[cfg(feature = "alloc")]
pub use reference_bvh::ReferenceBvhLightSampler;
pub use uniform::UniformLightSampler;
pub use visibility::{VisibilityCache, VisibilityLightSampler};
