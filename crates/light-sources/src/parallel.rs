use alloc::vec::Vec;

#[cfg(feature = "rayon")]
use rayon::{
    iter::{IndexedParallelIterator, ParallelIterator},
    slice::ParallelSliceMut,
};

/// The results of `each` for all rows of `table`, numbers of `width` each, in their order; on all
/// threads with the feature `rayon` if the table is large enough.
pub(crate) fn map_rows<T: Send>(
    table: &mut [f32],
    width: usize,
    each: impl Fn(u32, &mut [f32]) -> T + Send + Sync,
) -> Vec<T> {
    /// Smaller ones are done before another thread wakes.
    #[cfg(feature = "rayon")]
    const WORTH_A_THREAD: usize = 1 << 15;

    #[cfg(feature = "rayon")]
    if table.len() >= WORTH_A_THREAD {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "rows of images are counted by u32"
        )]
        let each = |(y, row)| each(y as u32, row);
        return table.par_chunks_mut(width).enumerate().map(each).collect();
    }
    let rows = (0..).zip(table.chunks_mut(width));
    rows.map(|(y, row)| each(y, row)).collect()
}
