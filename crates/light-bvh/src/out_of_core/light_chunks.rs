use alloc::vec::Vec;
use core::num::NonZeroUsize;
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

/// The lights of a slice, some at a time: for lists that are in memory anyway.
#[derive(Clone, Copy, Debug)]
pub struct SliceChunks<'a> {
    lights: &'a [LightExtent],
    in_a_chunk: NonZeroUsize,
    next: usize,
}

impl<'a> SliceChunks<'a> {
    /// All of `lights` in chunks of so many; the last may have fewer.
    #[must_use]
    pub const fn new(lights: &'a [LightExtent], in_a_chunk: NonZeroUsize) -> Self {
        Self {
            lights,
            in_a_chunk,
            next: 0,
        }
    }
}

impl LightChunks for SliceChunks<'_> {
    fn next_chunk(&mut self, chunk: &mut Vec<LightExtent>) -> io::Result<()> {
        let rest = &self.lights[self.next..];
        chunk.extend_from_slice(&rest[..rest.len().min(self.in_a_chunk.get())]);
        self.next += chunk.len();
        Ok(())
    }

    fn rewind(&mut self) -> io::Result<()> {
        self.next = 0;
        Ok(())
    }
}
