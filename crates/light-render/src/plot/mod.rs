//! Plots with logarithmic axes, as SVG: inside a page, or as a file of their own.

mod log_plot;
mod svg_file;

pub use log_plot::PlotSeries;
pub use svg_file::log_plot_file;

pub(crate) use log_plot::{log_plot, slope};
