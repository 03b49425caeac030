use alloc::vec::Vec;
use std::io;

use light_bounds::LightExtent;

/// Lights that are read in chunks, from a file or from a rule, in the order of their ids.
pub trait LightChunks {
    /// Appends the next lights to `chunk`, which is empty; none after the last. As many as are
    /// worth a read: some ten thousand.
    ///
    /// # Errors
    /// What keeps the lights from being read.
    fn next_chunk(&mut self, chunk: &mut Vec<LightExtent>) -> io::Result<()>;

    /// Goes back to the first light.
    ///
    /// # Errors
    /// What keeps the lights from being read again.
    fn rewind(&mut self) -> io::Result<()>;
}
