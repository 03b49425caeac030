//! What the fuzz targets do with their bytes: plain functions, so that tests on stable replay the same input.
//!
//! Each panics when a promise is broken, and answers nothing otherwise.

mod compact_bounds;
mod distributions;
mod input;
mod light_trees;
mod octahedral;
mod quantisation;
mod readers;

pub use compact_bounds::compact_bounds;
pub use distributions::distributions;
pub use light_trees::light_trees;
pub use octahedral::octahedral;
pub use quantisation::{box_quantisation, cosine_quantisation};
pub use readers::{read_gltf, read_image, read_luminaire, read_mtl, read_obj, read_pbrt, read_ply};

/// A target: what one input has to survive.
pub type Target = fn(&[u8]);

/// All targets by name, which is also the name of the folder of their corpus.
pub const TARGETS: [(&str, Target); 13] = [
    ("box_quantisation", box_quantisation),
    ("compact_bounds", compact_bounds),
    ("cosine_quantisation", cosine_quantisation),
    ("distributions", distributions),
    ("light_trees", light_trees),
    ("octahedral", octahedral),
    ("read_gltf", read_gltf),
    ("read_image", read_image),
    ("read_luminaire", read_luminaire),
    ("read_mtl", read_mtl),
    ("read_obj", read_obj),
    ("read_pbrt", read_pbrt),
    ("read_ply", read_ply),
];
