#![doc = include_str!("../README.md")]
#![no_std]
// Not forbidden where one private module, `wide::vectors`, calls code for wider vectors after asking whether the machine has them.
#![cfg_attr(not(all(feature = "std", target_arch = "x86_64")), forbid(unsafe_code))]
#![deny(unsafe_code, clippy::undocumented_unsafe_blocks)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

pub use light_bounds;

mod error;
#[cfg(feature = "alloc")]
mod join;
pub mod reference;
mod validate;
mod wide;

pub use error::LightBvhError;
pub use validate::validate;
#[cfg(feature = "alloc")]
pub use wide::{BuildMode, DarkLights, LightBvh, LightBvhOptions};
pub use wide::{
    CutDetail, CutDetailError, GlossyReceiver, Lane, LightBvhRef, LightCut, MAX_DEPTH,
    MediumReceiver, Receiver, SegmentReceiver, SurfaceReceiver, TwoSidedReceiver, WideNode, is_far,
    prefetch_item,
};
