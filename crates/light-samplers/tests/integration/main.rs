//! The integration tests of light-samplers, as one program.

#![cfg(feature = "alloc")]

mod first_choice;
mod groups;
mod instanced;
mod invalid_contexts;
mod known_probabilities;
mod laws;
#[cfg(feature = "std")]
mod out_of_core;
mod placed;
mod resampled;
mod support;
mod visibility;
