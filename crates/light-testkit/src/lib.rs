#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "doubles are rounded to what the tested f32 code takes, counts are small and positive"
)]

#[cfg(any(feature = "fuzz", feature = "soak", feature = "sources"))]
extern crate alloc;

pub use light_math::glam;
#[cfg(feature = "samplers")]
pub use light_samplers;
#[cfg(feature = "samplers")]
pub use light_sets;
#[cfg(feature = "sources")]
pub use light_sources;

#[cfg(feature = "samplers")]
mod adversarial_cases;
#[cfg(feature = "sources")]
pub mod brute_force;
mod cap;
mod chi_squared;
#[cfg(feature = "samplers")]
mod contribution;
mod density;
pub mod edge_cases;
#[cfg(feature = "samplers")]
mod emitter;
mod estimate;
#[cfg(feature = "fuzz")]
pub mod fuzz;
mod gamma;
mod kolmogorov_smirnov;
pub mod laws;
#[cfg(any(feature = "fuzz", feature = "soak"))]
mod light_agreement;
#[cfg(feature = "samplers")]
mod may_contribute;
pub mod naive;
#[cfg(feature = "sources")]
mod own_twin;
mod pinned;
#[cfg(feature = "samplers")]
mod placed_case;
mod quadrature;
mod real3;
mod rng;
#[cfg(feature = "samplers")]
mod sampler_case;
mod significance;
#[cfg(feature = "soak")]
pub mod soak;
#[cfg(feature = "stored")]
mod stored_tree;

pub use cap::Cap;
pub use chi_squared::{ChiSquared, chi_squared, chi_squared_survival};
pub use density::{DensityOutcome, DensityTest};
#[cfg(feature = "samplers")]
pub use emitter::Emitter;
pub use estimate::Estimate;
pub use gamma::{ln_gamma, regularized_gamma_q};
pub use kolmogorov_smirnov::{KolmogorovSmirnov, kolmogorov_smirnov_uniform};
#[cfg(feature = "samplers")]
pub use may_contribute::may_contribute;
#[cfg(feature = "sources")]
pub use own_twin::own_twin;
pub use pinned::{Fingerprint, assert_pinned};
#[cfg(feature = "samplers")]
pub use placed_case::PlacedCase;
pub use quadrature::{GaussLegendre, integrate};
pub use rng::Rng;
#[cfg(feature = "samplers")]
pub use sampler_case::SamplerCase;
pub use significance::{FAMILY_ERROR, PROGRAMS, SIGNIFICANCE, TESTS_PER_PROGRAM, tests_taken};
#[cfg(feature = "stored")]
pub use stored_tree::{in_bytes, stored};
