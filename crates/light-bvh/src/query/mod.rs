//! How a light is chosen, and how its probability is found.

#[cfg(feature = "alloc")]
mod all_pmfs;
pub(crate) mod ascent;
pub(crate) mod bvh_at;
pub(crate) mod bvh_ref;
pub(crate) mod descent;
mod doubtful;
pub(crate) mod into_receiver;
pub(crate) mod look_ahead;
mod queries;
pub(crate) mod select;
pub(crate) mod uncertain;
#[cfg(all(test, feature = "std", target_arch = "x86_64"))]
mod vector_width_tests;
pub(crate) mod weights;
