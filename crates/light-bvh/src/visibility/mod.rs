//! Which lights are seen, as a pure function of a place.

mod at_cell;
mod cell_factors;
mod cell_key;
#[cfg(feature = "alloc")]
mod coarse_cell;
#[cfg(feature = "alloc")]
mod counts;
mod factor_code;
#[cfg(feature = "alloc")]
mod fine_cell;
#[cfg(feature = "alloc")]
mod gain;
mod hash;
mod in_cell;
#[cfg(feature = "alloc")]
mod learn;
#[cfg(feature = "alloc")]
mod mean_importance;
mod multiply;
#[cfg(feature = "alloc")]
mod options;
#[cfg(feature = "alloc")]
mod ray_log;
#[cfg(feature = "alloc")]
mod rays;
#[cfg(feature = "alloc")]
mod share_code;
#[cfg(feature = "alloc")]
mod table;
mod table_error;
mod table_ref;
mod walk;
mod way;
#[cfg(feature = "alloc")]
mod worth;

pub use at_cell::LightBvhInCellAt;
pub use cell_factors::{CellFactors, CellFactorsError, CopiedNode, MAX_COPIED_NODES};
pub use cell_key::CellKey;
#[cfg(feature = "alloc")]
pub use coarse_cell::CoarseCell;
pub use factor_code::{decode_factor, encode_factor};
#[cfg(feature = "alloc")]
pub use fine_cell::FineCell;
pub use in_cell::LightBvhInCell;
#[cfg(feature = "alloc")]
pub use options::FillOptions;
#[cfg(feature = "alloc")]
pub use table::CellTable;
pub use table_error::CellTableError;
pub use table_ref::{CellEntry, CellTableParts, CellTableRef};
