//! The bodies of the fuzz targets: plain functions, so that tests on stable Rust replay the same
//! input.
//!
//! Each panics when a guarantee is violated.

mod amounts;
mod choices;
mod command_lines;
mod compact_bounds;
mod distributions;
mod images;
mod input;
mod light_sources;
mod light_trees;
mod lights;
mod media;
mod octahedral;
mod partials;
mod quantisation;
mod readers;
mod refits;
mod sampler_kind;
mod samplers;

pub use command_lines::command_lines;
pub use compact_bounds::compact_bounds;
pub use distributions::distributions;
pub use light_sources::light_sources;
pub use light_trees::light_trees;
pub use media::media;
pub use octahedral::octahedral;
pub use partials::partials;
pub use quantisation::{box_quantisation, cosine_quantisation};
pub use readers::{read_gltf, read_image, read_luminaire, read_mtl, read_obj, read_pbrt, read_ply};
pub use refits::refits;
pub use samplers::samplers;

/// The body of a target.
pub type Target = fn(&[u8]);

/// All targets by name, which is also the name of the folder of their corpus.
pub const TARGETS: [(&str, Target); 19] = [
    ("box_quantisation", box_quantisation),
    ("command_lines", command_lines),
    ("compact_bounds", compact_bounds),
    ("cosine_quantisation", cosine_quantisation),
    ("distributions", distributions),
    ("light_sources", light_sources),
    ("light_trees", light_trees),
    ("media", media),
    ("octahedral", octahedral),
    ("partials", partials),
    ("read_gltf", read_gltf),
    ("read_image", read_image),
    ("read_luminaire", read_luminaire),
    ("read_mtl", read_mtl),
    ("read_obj", read_obj),
    ("read_pbrt", read_pbrt),
    ("read_ply", read_ply),
    ("refits", refits),
    ("samplers", samplers),
];
