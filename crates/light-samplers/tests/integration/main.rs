//! The integration tests of light-samplers, as one program.
//!
//! Without std, where float functions are software, it is the modules with pinned values, closed
//! forms, and laws of what they compute by float functions. The others compare parts of the crate
//! with each other, by the same float functions, and take the most time.

#![cfg(feature = "alloc")]

#[cfg(feature = "std")]
mod first_choice;
#[cfg(feature = "std")]
mod groups;
#[cfg(feature = "std")]
mod instanced;
#[cfg(feature = "std")]
mod invalid_contexts;
mod known_probabilities;
#[cfg(feature = "std")]
mod laws;
#[cfg(feature = "std")]
mod out_of_core;
#[cfg(feature = "std")]
mod placed;
#[cfg(feature = "std")]
mod resampled;
mod support;
#[cfg(feature = "libm")]
mod value_stability;
mod visibility;
