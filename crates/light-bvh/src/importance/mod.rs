//! What the children of a node are worth to a receiver: one policy a file.

mod child_importance;
pub(crate) mod child_view;
pub(crate) mod glossy;
mod horizon;
pub(crate) mod medium;
pub(crate) mod position;
pub(crate) mod receiver;
pub(crate) mod segment;
pub(crate) mod surface;
pub(crate) mod two_sided;
