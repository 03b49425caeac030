use alloc::vec::Vec;

use light_bvh::light_math::distribution::AliasBin;
use light_bvh::{LightBvhRef, WideNode};

/// The words of a row.
const WORDS: usize = 4;

/// Rows of a tree: a head, the nodes, the order of the lights, and the slot of each light.
///
/// In a buffer from row `first` on they are what `light_tree(first)` reads. The head holds the
/// number of nodes, the rows of the order, and the number of lights; a node takes 14 rows.
///
/// Groups of lights are not among them: a shader chooses from all.
///
/// # Panics
/// If the tree has more than 2^32 / 14 nodes, whose rows a shader cannot count.
#[must_use]
pub fn light_tree_rows(tree: &LightBvhRef<'_>) -> Vec<[u32; 4]> {
    let order = tree.order().len().div_ceil(WORDS);
    let head = [tree.nodes().len(), order, tree.slots().len(), 0];
    let count = |n: usize| u32::try_from(n).expect("fewer than 2^32 rows");
    let mut rows = Vec::from([head.map(count)]);
    rows.extend_from_slice(node_rows(tree.nodes()));
    push_words(&mut rows, tree.order());
    push_words(&mut rows, tree.slots());
    let _ = count(rows.len());
    rows
}

/// The rows of nodes, which follow the head of a tree: after
/// [`refit`](light_bvh::LightBvh::refit) nothing else of it has changed.
#[must_use]
pub fn node_rows(nodes: &[WideNode]) -> &[[u32; 4]] {
    bytemuck::cast_slice(nodes)
}

/// The rows of an alias table, one a bin.
#[must_use]
pub fn alias_table_rows(bins: &[AliasBin]) -> Vec<[u32; 4]> {
    let row = |bin: &AliasBin| [bin.own, bin.alias, bin.pmf.to_bits(), 0];
    bins.iter().map(row).collect()
}

/// Adds words, four a row; the last row ends with zeros.
fn push_words(rows: &mut Vec<[u32; 4]>, words: &[u32]) {
    rows.extend(words.chunks(WORDS).map(|words| {
        let mut row = [0; WORDS];
        row[..words.len()].copy_from_slice(words);
        row
    }));
}
