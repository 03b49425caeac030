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
// Not forbidden where one private module, `simd`, calls code for wider vectors after testing
// whether the machine has them.
#![cfg_attr(not(all(feature = "std", target_arch = "x86_64")), forbid(unsafe_code))]
#![deny(unsafe_code, clippy::undocumented_unsafe_blocks)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

pub use light_bounds;
pub use light_bounds::glam;
pub use light_bounds::light_math;

#[cfg(feature = "alloc")]
mod build;
#[cfg(feature = "bytemuck")]
mod bytes;
mod cut;
mod error;
mod importance;
#[cfg(feature = "alloc")]
mod instances;
mod lane_math;
#[cfg(feature = "alloc")]
mod light_bvh;
mod node;
#[cfg(all(feature = "std", feature = "bytemuck"))]
pub mod out_of_core;
#[cfg(feature = "alloc")]
mod parallel;
mod query;
mod query_constants;
pub mod reference;
mod simd;
mod validate;
pub mod visibility;

#[cfg(feature = "alloc")]
pub use build::options::{BuildMode, DarkLights, LightBvhOptions};
#[cfg(feature = "bytemuck")]
pub use bytes::{StoredLightBvh, TreeBytesError};
pub use cut::light_cut::{CutDetail, CutDetailError, LightCut};
pub use error::LightBvhError;
pub use importance::child_view::ChildView;
pub use importance::context_receiver::ContextReceiver;
pub use importance::glossy::GlossyReceiver;
pub use importance::medium::MediumReceiver;
pub use importance::receiver::Receiver;
pub use importance::segment::SegmentReceiver;
pub use importance::surface::SurfaceReceiver;
pub use importance::two_sided::TwoSidedReceiver;
#[cfg(feature = "alloc")]
pub use instances::error::InstancedLightBvhError;
#[cfg(feature = "alloc")]
pub use instances::instanced_at::InstancedLightBvhAt;
#[cfg(feature = "alloc")]
pub use instances::instanced_bvh::InstancedLightBvh;
#[cfg(feature = "alloc")]
pub use instances::placed_light::{PlacedLight, SampledPlacedLight};
#[cfg(feature = "alloc")]
pub use instances::placement::{Placement, PlacementError};
#[cfg(feature = "alloc")]
pub use instances::prototype::LightPrototype;
#[cfg(feature = "alloc")]
pub use light_bvh::LightBvh;
pub use node::wide_node::{MAX_DEPTH, WideNode};
pub use query::bvh_at::LightBvhAt;
pub use query::bvh_ref::LightBvhRef;
pub use query::into_receiver::{IntoReceiver, KeptReceiver};
pub use query_constants::QUERY_CONSTANTS;
pub use simd::prefetch_item;
pub use validate::validate;
