//! Several choices at one receiver: a cut through the tree, refined where the estimate is rough.

pub(crate) mod grow;
pub(crate) mod light_cut;
pub(crate) mod sample;
