#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

#[cfg(feature = "alloc")]
extern crate alloc;

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
    CutDetail, GlossyReceiver, Lane, LightBvhRef, LightCut, MAX_DEPTH, MediumReceiver, Receiver,
    SegmentReceiver, SurfaceReceiver, TwoSidedReceiver, WideNode, is_far,
};
