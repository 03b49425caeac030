//! The bodies of the fuzz targets: plain functions, so that tests on stable Rust replay the same
//! input.
//!
//! Each panics when a guarantee is violated.

mod amounts;
mod choices;
mod command_lines;
mod compact_bounds;
mod distributions;
mod encodings;
mod images;
mod input;
mod instanced_trees;
mod light_sources;
mod light_trees;
mod lights;
mod media;
mod octahedral;
mod partials;
mod placed_scene;
mod quantisation;
mod readers;
mod refits;
mod sampler_kind;
mod samplers;

pub use command_lines::command_lines;
pub use encodings::encodings;
pub use instanced_trees::instanced_trees;
pub use light_sources::light_sources;
pub use light_trees::light_trees;
pub use media::media;
pub use partials::partials;
pub use readers::readers;
pub use refits::refits;
pub use samplers::samplers;

/// The body of a target.
pub type Target = fn(&[u8]);

/// All targets by name, which is also the name of the folder of their corpus.
pub const TARGETS: [(&str, Target); 10] = [
    ("command_lines", command_lines),
    ("encodings", encodings),
    ("instanced_trees", instanced_trees),
    ("light_sources", light_sources),
    ("light_trees", light_trees),
    ("media", media),
    ("partials", partials),
    ("readers", readers),
    ("refits", refits),
    ("samplers", samplers),
];
