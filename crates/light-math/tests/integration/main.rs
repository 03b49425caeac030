//! The integration tests of light-math, as one program.
//!
//! Without std, where float functions are software, it is the modules with pinned values, closed
//! forms, and laws of what they compute by float functions. The others compare parts of the crate
//! with each other, by the same float functions, and take the most time.

mod distributions;
#[cfg(feature = "std")]
mod opposite_corners;
mod real3;
#[cfg(feature = "std")]
mod reservoirs;
#[cfg(feature = "std")]
mod rounding;
mod solid_angles;
#[cfg(feature = "libm")]
mod value_stability;
mod warps;
