//! The right answers in double precision, from the published formulas and without the library under
//! test.
//!
//! Single precision is modelled as double precision for inputs that are off by a few units in the
//! last place: a [`Jitter`] moves them, and an answer is right if it is the answer for inputs as
//! near as that.

pub(super) mod codes;
pub(super) mod cone;
pub(super) mod cone_rounding;
pub(super) mod equal_area;
mod jitter;
pub(super) mod lights;
pub(super) mod parts;
mod spherical_rectangle;
mod spherical_triangle;
pub(super) mod subtended;
pub(super) mod table;
pub(super) mod warp;
mod window;

pub(super) use jitter::{Certainty, Conditioning, Jitter, Ours, confirm, range};
pub(super) use spherical_rectangle::ExactRectangle;
pub(super) use spherical_triangle::ExactTriangle;
pub(super) use window::ExactWindows;
