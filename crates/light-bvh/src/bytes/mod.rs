//! Trees as bytes: in a file, in flash, or in a buffer of a GPU.

mod header;
mod links;
#[cfg(feature = "alloc")]
mod owned;
mod stored;

pub use header::TreeBytesError;
#[cfg(feature = "std")]
pub(crate) use header::{HEADER, Header};
pub use stored::StoredLightBvh;
