//! The integration tests of light-testkit, as one program.

extern crate alloc;

mod coverage;
mod fuzz_corpus;
mod own_lights;
mod power;
mod sampler_laws;
