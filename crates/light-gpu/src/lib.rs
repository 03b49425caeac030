#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

extern crate alloc;

pub use light_samplers;
pub use light_samplers::light_bvh;
pub use light_sources;

mod light_rows;
mod rows;
mod scene_rows;
mod source;

pub use light_rows::{UnsupportedLight, light_set_rows};
pub use rows::{
    TooManyInfiniteLights, alias_table_rows, compact_bounds_rows, light_sampler_rows,
    light_tree_rows, node_rows,
};
pub use scene_rows::{LightSceneRowsError, light_scene_rows};
pub use source::{LIGHTS_WGSL, constants, flat};
