//! A picture while it is made: in a viewer, and again when files change.

mod file_stamps;
mod tev;
mod tev_packets;

pub(crate) use file_stamps::FileStamps;
pub(crate) use tev::{TevAddress, TevViewer};
