//! The integration tests of lights, as one program.

mod examples;
#[cfg(feature = "alloc")]
mod lobes;
mod updates;
