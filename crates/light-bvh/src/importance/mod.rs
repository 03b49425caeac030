//! What the children of a node are worth to whoever asks.

pub(crate) mod child_view;
pub(crate) mod glossy;
pub(crate) mod segment;
pub(crate) mod surface;
