//! The integration tests of light-gpu, as one program.

mod light_rows;
mod page;
mod rows;
mod shaders;
