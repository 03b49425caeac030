//! The integration tests of light-bvh, as one program.
//!
//! Without std, where float functions are software, it is the modules with pinned values, closed
//! forms, and laws of what they compute by float functions. The others compare parts of the crate
//! with each other, by the same float functions, and take the most time.

#![cfg(feature = "alloc")]

extern crate alloc;

#[cfg(feature = "std")]
mod cell_filling;
#[cfg(feature = "std")]
mod cell_queries;
#[cfg(feature = "std")]
mod cell_table;
#[cfg(feature = "libm")]
mod cell_values;
#[cfg(feature = "std")]
mod cones;
#[cfg(feature = "std")]
mod cut_pmfs;
#[cfg(feature = "std")]
mod emission;
#[cfg(feature = "std")]
mod errors;
#[cfg(feature = "std")]
mod guards;
#[cfg(feature = "std")]
mod moved_cells;
#[cfg(feature = "std")]
mod nearest_cells;
mod opposed_beams;
#[cfg(all(feature = "std", feature = "bytemuck"))]
mod out_of_core;
#[cfg(feature = "std")]
mod placed_edges;
#[cfg(feature = "std")]
mod placed_far;
#[cfg(feature = "std")]
mod placed_open;
#[cfg(feature = "std")]
mod placed_parts;
#[cfg(feature = "std")]
mod queries;
#[cfg(feature = "std")]
mod receivers;
#[cfg(feature = "std")]
mod reference_faults;
mod reference_properties;
#[cfg(feature = "std")]
mod refit;
mod rows_of_lamps;
mod support;
#[cfg(all(feature = "std", feature = "rayon"))]
mod threads;
#[cfg(all(feature = "std", feature = "bytemuck"))]
mod tree_bytes;
#[cfg(feature = "libm")]
mod value_stability;
mod wide;
