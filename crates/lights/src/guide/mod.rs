//! A guide in short chapters: what to choose, in which units, what to expect of it.
//!
//! 1. [`samplers`]: which sampler when, one choice or several, what a sampler does not know.
//! 2. [`units`]: candela, lumen, nit, lux and watt; RGB against spectra.
//! 3. [`skies`]: how environment maps lie, how bright they are, how they are sampled.
//! 4. [`estimates`]: what a sample is an estimate of, and how two strategies share one integral.
//! 5. [`determinism`]: the same bits on every machine, for any number of threads, in parts.
//! 6. [`costs`]: memory and time by the number of lights, and what to measure on your own scene.
//!
//! The [examples](https://github.com/lights-rs/lights/tree/main/crates/lights/examples) are whole
//! programs; the code of the chapters is compiled and run by `cargo test`.

#[doc = include_str!("samplers.md")]
pub mod samplers {}

#[doc = include_str!("units.md")]
pub mod units {}

#[doc = include_str!("skies.md")]
pub mod skies {}

#[doc = include_str!("estimates.md")]
pub mod estimates {}

#[doc = include_str!("determinism.md")]
pub mod determinism {}

#[doc = include_str!("costs.md")]
pub mod costs {}
