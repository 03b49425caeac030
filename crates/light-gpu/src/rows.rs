use alloc::vec::Vec;
use core::fmt;

use light_samplers::BvhLightSamplerRef;
use light_samplers::light_bvh::light_bounds::{CompactLightBounds, InfiniteBounds};
use light_samplers::light_bvh::light_math::Aabb;
use light_samplers::light_bvh::light_math::distribution::AliasBin;
use light_samplers::light_bvh::{LightBvhRef, WideNode};

/// The words of a row.
const WORDS: usize = 4;

/// The tree and so many lights at infinity are one choice, by the rule of `light_math::discrete`.
const MOST_INFINITE: u32 = 63;

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

/// Rows of a sampler: a head, three for each light at infinity, and those of its tree.
///
/// In a buffer from row `first` on they are what `light_sampler(first)` reads. The head holds the
/// power of the tree and the number of lights at infinity. A shader finds these one by one: it is
/// made for a few.
///
/// # Errors
/// [`TooManyInfiniteLights`] if there are more than 63 lights at infinity.
///
/// # Panics
/// As [`light_tree_rows`].
pub fn light_sampler_rows(
    sampler: &BvhLightSamplerRef<'_>,
) -> Result<Vec<[u32; 4]>, TooManyInfiniteLights> {
    let infinite = sampler.infinite_lights();
    let count = match u32::try_from(infinite.len()) {
        Ok(count) if count <= MOST_INFINITE => count,
        _ => return Err(TooManyInfiniteLights),
    };
    let mut rows = Vec::from([[sampler.power().to_bits(), count, 0, 0]]);
    for light in infinite {
        let InfiniteBounds {
            fluence,
            mean,
            cone,
        } = light.bounds;
        rows.push(mean.extend(fluence).to_array().map(f32::to_bits));
        rows.push(cone.w.extend(cone.cos_theta).to_array().map(f32::to_bits));
        rows.push([light.light.0, 0, 0, 0]);
    }
    rows.extend(light_tree_rows(&sampler.tree()));
    Ok(rows)
}

/// The lights at infinity of a sampler are more than the 63 that a shader chooses from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooManyInfiniteLights;

impl fmt::Display for TooManyInfiniteLights {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "more than {MOST_INFINITE} lights at infinity")
    }
}

impl core::error::Error for TooManyInfiniteLights {}

/// The rows of nodes, which follow the head of a tree: after
/// [`refit`](light_samplers::light_bvh::LightBvh::refit) nothing else of it has changed.
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

/// Rows of bounds of lights within the box `all`: two of the box and the number of lights, then six
/// words a light.
///
/// In a buffer from row `first` on they are what `light_compact_bounds(first)` reads.
///
/// # Panics
/// If there are more than 2^29 lights, whose words a shader cannot count.
#[must_use]
pub fn compact_bounds_rows(bounds: &[CompactLightBounds], all: &Aabb) -> Vec<[u32; 4]> {
    let count = u32::try_from(bounds.len()).ok().filter(|&n| n <= 1 << 29);
    let count = count.expect("fewer than 2^32 words");
    let [ax, ay, az] = all.min.to_array().map(f32::to_bits);
    let [bx, by, bz] = all.max.to_array().map(f32::to_bits);
    let mut rows = Vec::from([[ax, ay, az, count], [bx, by, bz, 0]]);
    push_words(&mut rows, bytemuck::cast_slice(bounds));
    rows
}

/// Adds words, four a row; the last row ends with zeros.
pub(crate) fn push_words(rows: &mut Vec<[u32; 4]>, words: &[u32]) {
    rows.extend(words.chunks(WORDS).map(|words| {
        let mut row = [0; WORDS];
        row[..words.len()].copy_from_slice(words);
        row
    }));
}
