//! Cells made by rays, and their table; queries read what is above this folder.

mod bottom_up;
mod coarse_cell;
mod counts;
mod fine_cell;
mod gain;
mod learn;
mod mean_importance;
mod options;
mod ray_log;
mod rays;
mod share_code;
mod table;
#[cfg(test)]
mod tests;

pub use coarse_cell::CoarseCell;
pub use fine_cell::FineCell;
pub use options::FillOptions;
pub use table::CellTable;
