//! What several of the tests share.

pub(crate) mod ball;
pub(crate) mod convergence;
