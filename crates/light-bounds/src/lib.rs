#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

pub use light_math;
pub use light_math::glam;

mod angle;
mod compact;
mod context;
mod emission_lobe;
mod error;
mod extent;
mod importance;
mod light_bounds;
mod light_groups;
mod light_id;
mod sampled_light;

pub use compact::CompactLightBounds;
pub use context::{Gloss, LightSampleContext, ReceiverKind, ReceiverSides};
pub use emission_lobe::{EmissionLine, EmissionLobe};
pub use error::{InfiniteBoundsError, LightBoundsError};
pub use extent::{InfiniteBounds, LightExtent};
pub use importance::IMPORTANCE_CONSTANTS;
pub use light_bounds::LightBounds;
pub use light_groups::LightGroups;
pub use light_id::LightId;
pub use sampled_light::SampledLight;
