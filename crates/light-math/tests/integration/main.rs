//! The integration tests of light-math, as one program.

mod distributions;
mod opposite_corners;
mod real3;
mod reservoirs;
mod rounding;
mod solid_angles;
#[cfg(feature = "libm")]
mod value_stability;
mod warps;
