//! Light sets as text: the lights and the shading points of a set in a file each.

mod error;
mod reader;
mod writer;

pub use error::{LightSetError, LightSetProblem};
pub use reader::read_light_set;
pub use writer::write_light_set;
