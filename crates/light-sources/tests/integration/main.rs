//! The integration tests of light-sources, as one program.
//!
//! Without std, where float functions are software, it is the modules with pinned values, closed
//! forms, and laws of what they compute by float functions. The others compare parts of the crate
//! with each other, by the same float functions, and take the most time.

extern crate alloc;

#[cfg(feature = "std")]
mod black_pictures;
#[cfg(feature = "std")]
mod brute_force;
mod conversions;
#[cfg(feature = "std")]
mod descriptions;
#[cfg(feature = "std")]
mod errors;
#[cfg(feature = "std")]
mod even_images;
#[cfg(feature = "std")]
mod extreme_descriptions;
mod far_from_the_origin;
#[cfg(feature = "std")]
mod grazing_edges;
#[cfg(feature = "std")]
mod hits;
mod known_values;
#[cfg(feature = "std")]
mod laws;
#[cfg(feature = "std")]
mod light_refs;
#[cfg(feature = "std")]
mod masks;
#[cfg(feature = "std")]
mod own_lights;
#[cfg(feature = "std")]
mod own_plane;
mod photometric;
#[cfg(feature = "std")]
mod picture_edges;
#[cfg(feature = "std")]
mod refusals;
#[cfg(all(feature = "std", feature = "rayon"))]
mod threads;
#[cfg(feature = "std")]
mod tiny_shapes;
#[cfg(feature = "std")]
mod units_of_length;
#[cfg(feature = "libm")]
mod value_stability;
