use alloc::vec::Vec;

use crate::node::wide_node::WIDTH;
use crate::visibility::cell_factors::CopiedNode;
use crate::visibility::cell_key::CellKey;
use crate::visibility::fill::coarse_cell::CoarseCell;
use crate::visibility::fill::fine_cell::FineCell;
use crate::visibility::table_error::CellTableError;
use crate::visibility::table_ref::{CellEntry, CellTableParts, CellTableRef, bucket};

/// The table of all cells of a scene, by key.
///
/// 32 bytes a cell, 20 a copied node of a coarse cell and 16 of a fine one that has factors of its
/// own.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CellTable {
    keys: Vec<CellKey>,
    entries: Vec<CellEntry>,
    starts: Vec<u32>,
    shapes: Vec<CopiedNode>,
    factors: Vec<[u8; WIDTH]>,
}

impl CellTable {
    /// The table of these cells: the same for any order of them. Takes a sort.
    ///
    /// # Errors
    /// A key that is there twice, a fine cell without its coarse cell, or more cells than 32 bits
    /// count.
    pub fn new(coarse: &[CoarseCell], fine: &[FineCell]) -> Result<Self, CellTableError> {
        let mut table = Self::default();
        let mut found: Vec<(u64, CellKey, CellEntry)> = Vec::new();
        for cell in sorted(coarse, |cell| cell.key) {
            let entry = CellEntry {
                shape: count(table.shapes.len())?,
                factors: count(table.factors.len())?,
                nodes: count(cell.shape.len())?,
            };
            table.shapes.extend_from_slice(&cell.shape);
            table.factors.extend_from_slice(&cell.factors);
            found.push((cell.key.seed(), cell.key, entry));
        }
        let coarse = found.len();
        for cell in sorted(fine, |cell| cell.key) {
            let entry = table.fine_entry(cell, &found[..coarse])?;
            table.factors.extend_from_slice(&cell.factors);
            found.push((cell.key.seed(), cell.key, entry));
        }
        found.sort_unstable_by_key(|&(seed, key, _)| (seed, key));
        if let Some(pair) = found.windows(2).find(|pair| pair[0].1 == pair[1].1) {
            return Err(CellTableError::Twice { key: pair[0].1 });
        }
        let (keys, mut place) = (count(found.len())?, 0);
        for part in 0..=found.len() {
            let is_before = |at: &(u64, CellKey, CellEntry)| bucket(found.len(), at.0) < part;
            while found.get(place as usize).is_some_and(is_before) {
                place += 1;
            }
            table.starts.push(place.min(keys));
        }
        table.keys = found.iter().map(|&(_, key, _)| key).collect();
        table.entries = found.iter().map(|&(_, _, entry)| entry).collect();
        Ok(table)
    }

    /// The entry of a fine cell whose factors come next.
    fn fine_entry(
        &self,
        cell: &FineCell,
        coarse: &[(u64, CellKey, CellEntry)],
    ) -> Result<CellEntry, CellTableError> {
        let (key, missing) = (cell.key, CellTableError::NoCoarseCell { key: cell.key });
        let of = (key.coarse().seed(), key.coarse());
        let place = coarse.binary_search_by_key(&of, |&(seed, key, _)| (seed, key));
        let entry = coarse[place.map_err(|_| missing)?].2;
        if cell.factors.is_empty() {
            return Ok(entry);
        }
        if cell.factors.len() != entry.nodes as usize {
            return Err(missing);
        }
        let factors = count(self.factors.len())?;
        Ok(CellEntry { factors, ..entry })
    }

    /// The table on borrowed slices.
    #[must_use]
    pub fn view(&self) -> CellTableRef<'_> {
        CellTableRef::of(CellTableParts {
            keys: &self.keys,
            entries: &self.entries,
            starts: &self.starts,
            shapes: &self.shapes,
            factors: &self.factors,
        })
    }

    /// Bytes of all arrays.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.view().bytes()
    }
}

/// Cells in the order of their seeds.
fn sorted<T>(cells: &[T], key: impl Fn(&T) -> CellKey) -> Vec<&T> {
    let mut sorted: Vec<&T> = cells.iter().collect();
    sorted.sort_by_key(|cell| (key(cell).seed(), key(cell)));
    sorted
}

fn count(count: usize) -> Result<u32, CellTableError> {
    u32::try_from(count).map_err(|_| CellTableError::TooLarge)
}
