//! What several of the tests share.

#[cfg(feature = "std")]
pub(crate) mod asked;
pub(crate) mod lamp_over_floor;
