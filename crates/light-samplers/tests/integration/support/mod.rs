//! What several of the tests share.

pub(crate) mod asked;
pub(crate) mod lamp_over_floor;
