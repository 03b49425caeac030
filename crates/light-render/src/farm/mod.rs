//! Jobs for render farms: a picture, or each frame of an animation, in parts by its samples, and the
//! merge that waits for them.
//!
//! What a task does stands in three scripts that need a shell and the program alone; what is said
//! to an engine only names them, so that every engine does the same.

mod engine;
mod frames;
mod hyperqueue;
mod job_file;
mod openjd;
mod plan;
mod scripts;
mod shell;
mod slurm;

pub use engine::FarmEngine;
pub(crate) use job_file::{is_job_file, job_file_names};

pub use frames::{FarmFrames, FrameNumbers};
pub use plan::{FarmPlan, FarmPlanError};
