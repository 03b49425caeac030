//! Several choices at one place: a cut through the tree, looked at closely first.

pub(crate) mod grow;
pub(crate) mod light_cut;
pub(crate) mod sample;
