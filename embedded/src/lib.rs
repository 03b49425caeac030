#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(not(target_os = "none"))]
extern crate std;

mod apart;
mod digest;
mod flash;
mod light_record;
mod machine;
mod measure;
mod queries;
mod random;
mod scene_records;
mod sky;

pub use queries::{choices, lights, sampler, tables, tree};
