use light_bounds::LightSampleContext;
use light_math::fraction;

use crate::node::wide_node::WIDTH;
use crate::query::bvh_ref::LightBvhRef;
use crate::visibility::cell_factors::{CellFactors, CellFactorsError, CopiedNode};
use crate::visibility::cell_key::CellKey;
use crate::visibility::table_error::CellTableError;

/// The entry of one key: where its copied nodes and factors are. 12 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(C)]
pub struct CellEntry {
    /// The first of its copied nodes; those of a fine cell are its coarse cell's.
    pub shape: u32,
    /// The first of its factors.
    pub factors: u32,
    /// How many nodes it has; 0 in a plain cell.
    pub nodes: u32,
}

/// The arrays of a table of cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellTableParts<'a> {
    /// All keys in ascending order of their [seeds](CellKey::seed).
    pub keys: &'a [CellKey],
    /// The entry of each key.
    pub entries: &'a [CellEntry],
    /// Of as many equal parts of the range of seeds as there are keys, the first key of each; then
    /// the number of keys.
    pub starts: &'a [u32],
    /// Copied nodes.
    pub shapes: &'a [CopiedNode],
    /// Codes of factors.
    pub factors: &'a [[u8; WIDTH]],
}

/// A table of cells on borrowed slices: all that looking one up needs.
///
/// A look-up takes a hash, and about one load of each of three arrays.
#[derive(Clone, Copy, Debug)]
pub struct CellTableRef<'a> {
    parts: CellTableParts<'a>,
}

impl<'a> CellTableRef<'a> {
    /// The table of these arrays, for `tree`.
    ///
    /// # Errors
    /// The first rule that is broken: see [`CellTableError`]. Reads every key and factor once.
    pub fn new(tree: &LightBvhRef<'_>, parts: CellTableParts<'a>) -> Result<Self, CellTableError> {
        let CellTableParts { keys, starts, .. } = parts;
        if parts.entries.len() != keys.len() || starts.len() != keys.len() + 1 {
            return Err(CellTableError::Lengths);
        }
        let order = |key: &CellKey| (key.seed(), *key);
        if !keys.is_sorted_by(|a, b| order(a) < order(b)) || !are_starts(keys, starts) {
            return Err(CellTableError::Order);
        }
        let table = Self::of(parts);
        for entry in parts.entries {
            let (shape, factors) = table.parts_of(*entry).ok_or(CellTableError::Links)?;
            CellFactors::new(tree, shape, factors).map_err(|error| match error {
                CellFactorsError::Factor => CellTableError::Factor,
                _ => CellTableError::Links,
            })?;
        }
        Ok(table)
    }

    /// The same without checks, for arrays that this crate made.
    pub(super) const fn of(parts: CellTableParts<'a>) -> Self {
        Self { parts }
    }

    /// The arrays.
    #[must_use]
    pub const fn parts(&self) -> CellTableParts<'a> {
        self.parts
    }

    /// The cell of `key`; `None` if it is not in the table.
    #[inline]
    #[must_use]
    pub fn find(&self, key: CellKey) -> Option<CellFactors<'a>> {
        let CellTableParts { keys, starts, .. } = self.parts;
        let bucket = bucket(keys.len(), key.seed());
        let (start, end) = (*starts.get(bucket)?, *starts.get(bucket + 1)?);
        let within = keys.get(start as usize..end as usize)?;
        let index = start as usize + within.iter().position(|at| *at == key)?;
        let (shape, factors) = self.parts_of(*self.parts.entries.get(index)?)?;
        Some(CellFactors::of(shape, factors))
    }

    /// The factors at a receiver in the fine cell `key`: those of the cell, or of its coarse cell
    /// if it is not in the table, or none.
    #[inline]
    #[must_use]
    pub fn factors(&self, key: CellKey) -> CellFactors<'a> {
        let found = self.find(key).or_else(|| self.find(key.coarse()));
        found.unwrap_or(CellFactors::PLAIN)
    }

    /// The factors at `ctx`: those of its fine cell; of the first of its
    /// [nearest neighbours](CellKey::nearest_neighbours) that is in the table if its own is not;
    /// of its coarse cell then. None where its coarse cell is not in the table.
    #[inline]
    #[must_use]
    pub fn nearest_factors(&self, ctx: &LightSampleContext, coarse_size: f32) -> CellFactors<'a> {
        let key = CellKey::fine(ctx, coarse_size);
        if let Some(own) = self.find(key) {
            return own;
        }
        let Some(coarse) = self.find(key.coarse()) else {
            return CellFactors::PLAIN;
        };
        let near = CellKey::nearest_neighbours(ctx, coarse_size);
        near.iter()
            .find_map(|key| self.find(*key))
            .unwrap_or(coarse)
    }

    /// Bytes of all arrays.
    #[must_use]
    pub const fn bytes(&self) -> usize {
        let CellTableParts {
            keys,
            entries,
            starts,
            shapes,
            factors,
        } = self.parts;
        let found = size_of_val(keys) + size_of_val(entries) + size_of_val(starts);
        found + size_of_val(shapes) + size_of_val(factors)
    }

    /// Nodes and factors of an entry.
    #[inline]
    fn parts_of(&self, entry: CellEntry) -> Option<(&'a [CopiedNode], &'a [[u8; WIDTH]])> {
        let CellTableParts {
            shapes, factors, ..
        } = self.parts;
        let nodes = entry.nodes as usize;
        if nodes == 0 {
            return Some((&[], &[]));
        }
        let shape = shapes.get(entry.shape as usize..)?.get(..nodes)?;
        let factors = factors.get(entry.factors as usize..)?.get(..nodes)?;
        Some((shape, factors))
    }
}

/// Which of `count` equal parts of all seeds one is in.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "tables count by 32 bits")]
pub(super) const fn bucket(count: usize, seed: u64) -> usize {
    fraction::choose(count as u32, seed).0 as usize
}

/// Whether each of the `starts` is the number of keys in the parts before it.
fn are_starts(keys: &[CellKey], starts: &[u32]) -> bool {
    let mut place = 0;
    for (part, &start) in starts.iter().enumerate() {
        while keys
            .get(place)
            .is_some_and(|key| bucket(keys.len(), key.seed()) < part)
        {
            place += 1;
        }
        if start as usize != place {
            return false;
        }
    }
    true
}
