#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]
#![cfg_attr(
    test,
    allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "tests integrate in f64 and count in bins"
    )
)]

#[cfg(feature = "std")]
extern crate std;

pub use light_math;
pub use light_math::glam;

pub mod phase;
mod stratify;

pub use phase::{Phase, PhaseFunction, PhaseSample};
pub use stratify::LatinHypercube;
