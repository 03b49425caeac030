//! The integration tests of light-sources, as one program.

extern crate alloc;

mod brute_force;
mod conversions;
mod descriptions;
mod errors;
mod even_images;
mod extreme_descriptions;
mod far_from_the_origin;
mod grazing_edges;
mod hits;
mod known_values;
mod laws;
mod light_refs;
mod masks;
mod own_lights;
mod photometric;
mod picture_edges;
mod refusals;
#[cfg(feature = "rayon")]
mod threads;
mod tiny_shapes;
mod units_of_length;
