//! Queries as records of a buffer, and what the core answers to them. Kernels and the host both
//! call these functions: what a GPU computes is compared bit for bit.

#![no_std]
#![forbid(unsafe_code)]

mod answers;
mod light_record;
mod query;
mod random;

pub use answers::{Arrived, Choices, Chosen, arrive, decode, pmf, sample, sample_by_cut};
pub use light_record::LightRecord;
pub use query::{Query, Receiver};
pub use random::Random;
