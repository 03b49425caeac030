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
#![cfg_attr(
    test,
    allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "tests integrate in f64 and count in bins"
    )
)]

#[cfg(any(test, feature = "alloc"))]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

pub use light_bounds;
pub use light_math;
pub use light_math::glam;
pub use light_samplers;
pub use light_sources;

mod delta_tracking;
mod emission;
#[cfg(feature = "alloc")]
mod in_scattering;
mod latin_hypercube;
mod medium;
#[cfg(feature = "alloc")]
mod next_event;
pub mod phase;
#[cfg(feature = "alloc")]
mod phase_mis;
mod ray;
mod ray_march;
mod region;
#[cfg(feature = "alloc")]
mod single_scattering;
mod step_size;
mod tentative_collisions;
pub mod transmittance;
#[cfg(feature = "alloc")]
mod truncated_exponential;

pub use delta_tracking::{Flight, delta_tracking};
pub use emission::{VolumeLight, emission};
#[cfg(feature = "alloc")]
pub use in_scattering::{ScatteringPoint, Visibility, VolumeIntegrator};
pub use latin_hypercube::LatinHypercube;
#[cfg(feature = "alloc")]
pub use medium::{AnyMedium, Incandescence, TemperatureGrid};
pub use medium::{
    Coefficients, CoefficientsError, ColorGrid, ColorGridError, ColorGridMedium, DensityGrid,
    ExponentialHeight, ExponentialHeightError, Glow, Grid, GridError, GridMedium, GridMediumError,
    Homogeneous, MajorantSegment, Majorants, Medium, Substance,
};
pub use phase::{Phase, PhaseFunction, PhaseSample};
#[cfg(feature = "alloc")]
pub use phase_mis::{FirstHit, Intersection, ScatteringNumbers};
pub use ray::{Ray, Span};
pub use region::{Region, RegionError};
pub use step_size::{March, StepSize, StepSizeError};
