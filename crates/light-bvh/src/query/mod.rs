//! How a light is chosen, and how its probability is found.

pub(crate) mod bvh_ref;
pub(crate) mod into_receiver;
pub(crate) mod select;
pub(crate) mod weights;
pub(crate) mod with_infinite;
