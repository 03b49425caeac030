//! The importance of the children of a node to a receiver: one kind of receiver a file.

pub(crate) mod child_importance;
pub(crate) mod child_view;
pub(crate) mod context_receiver;
#[cfg(feature = "alloc")]
pub(crate) mod frame;
pub(crate) mod glossy;
pub(crate) mod horizon;
pub(crate) mod medium;
pub(crate) mod position;
pub(crate) mod receiver;
pub(crate) mod segment;
pub(crate) mod sheet;
pub(crate) mod surface;
pub(crate) mod two_sided;
