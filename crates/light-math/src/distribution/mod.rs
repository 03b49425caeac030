//! Tables to sample from, over storage of the caller's choice.
//!
//! A table is built once from weights and then only read. Its numbers live in anything that lends a
//! slice: a `Vec`, a borrowed buffer, an array in a `static`. Sampling never returns a value of
//! zero density, for any `u`.

mod alias_bin;
mod alias_sweep;
mod alias_table;
mod axis;
mod cumulative;
mod densities;
mod error;
mod piecewise_constant_1d;
mod piecewise_constant_2d;
mod position;
mod quotient;
mod reservoir;
mod span;
mod summed_area_table;
mod whole_sums;
mod window;
mod windowed_piecewise_constant_2d;

pub use alias_bin::AliasBin;
pub use alias_table::AliasTable;
pub use error::TableError;
pub use piecewise_constant_1d::{PiecewiseConstant1D, Sample1D};
pub use piecewise_constant_2d::{PiecewiseConstant2D, Sample2D};
pub use reservoir::WeightedReservoir;
pub use summed_area_table::SummedAreaTable;
pub use window::Window;
pub use windowed_piecewise_constant_2d::WindowedPiecewiseConstant2D;
