use core::error::Error;
use core::fmt;

use crate::visibility::cell_key::CellKey;

/// Why cells or arrays do not make a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CellTableError {
    /// Two cells have the same key.
    Twice {
        /// Which one.
        key: CellKey,
    },
    /// The coarse cell of a fine one is missing, or has another number of nodes.
    NoCoarseCell {
        /// The key of the fine cell.
        key: CellKey,
    },
    /// There are more cells, or nodes, than 32 bits count.
    TooLarge,
    /// The arrays are not as long as they have to be.
    Lengths,
    /// The keys are not in the order of their seeds, each once, or are not where they are looked
    /// for.
    Order,
    /// A cell is not the top of the tree, or lies outside of the arrays.
    Links,
    /// The code of a factor is outside of its domain, `120..=240`.
    Factor,
}

impl fmt::Display for CellTableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Twice { key } => write!(f, "two cells have the key {key:?}"),
            Self::NoCoarseCell { key } => write!(f, "no coarse cell that fits {key:?}"),
            Self::TooLarge => f.write_str("more cells than a table can address"),
            Self::Lengths => f.write_str("the arrays do not have the lengths of a table"),
            Self::Order => f.write_str("the keys are not in order"),
            Self::Links => f.write_str("a cell is not the top of the tree"),
            Self::Factor => f.write_str("the code of a factor is outside of 120 to 240"),
        }
    }
}

impl Error for CellTableError {}
