//! The integration tests of light-bvh, as one program.

#![cfg(feature = "alloc")]

extern crate alloc;

mod cell_filling;
mod cell_queries;
mod cell_table;
#[cfg(feature = "libm")]
mod cell_values;
mod cones;
mod cut_pmfs;
mod emission;
mod errors;
mod guards;
mod moved_cells;
mod nearest_cells;
#[cfg(all(feature = "std", feature = "bytemuck"))]
mod out_of_core;
mod placed_edges;
mod placed_far;
mod placed_open;
mod placed_parts;
mod queries;
mod receivers;
mod reference_faults;
mod reference_properties;
mod refit;
mod support;
#[cfg(feature = "rayon")]
mod threads;
#[cfg(feature = "bytemuck")]
mod tree_bytes;
#[cfg(feature = "libm")]
mod value_stability;
mod wide;
