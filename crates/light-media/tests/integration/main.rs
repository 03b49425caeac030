//! The integration tests of light-media, as one program.
//!
//! Without std, where float functions are software, it is the modules with pinned values, closed
//! forms, and laws of what they compute by float functions. The others compare parts of the crate
//! with each other, by the same float functions, and take the most time.

mod closed_forms;
#[cfg(feature = "std")]
mod convergence;
#[cfg(feature = "std")]
mod defaults;
#[cfg(feature = "std")]
mod edges;
#[cfg(feature = "std")]
mod extreme_media;
#[cfg(feature = "std")]
mod kinds_of_media;
#[cfg(feature = "std")]
mod lights_in_media;
#[cfg(feature = "std")]
mod next_event;
#[cfg(feature = "std")]
mod no_light;
#[cfg(feature = "std")]
mod own_lights;
#[cfg(feature = "std")]
mod phase_mis;
#[cfg(feature = "std")]
mod support;
#[cfg(feature = "std")]
mod trackers;
#[cfg(feature = "libm")]
mod value_stability;
