use alloc::vec::Vec;

use crate::build::cluster::Cluster;
use crate::build::light_primitive::LightPrimitive;
use crate::build::morton_range::MortonRange;
use crate::build::split_group::SplitGroup;
use crate::parallel::{join, map};

/// Lights of a cluster, at most.
const CLUSTER: usize = 16;

/// Clusters that one job makes.
const CHUNK: usize = 512;

/// The ends of clusters of neighbours, as positions among all entries: the cells of an octree that
/// hold few lights. `first` is the position of the first entry of the range.
#[expect(
    clippy::cast_possible_truncation,
    reason = "a tree holds fewer than 2^32 lights"
)]
pub(crate) fn ends(range: MortonRange<'_>, first: u32) -> Vec<u32> {
    /// Fewer lights are listed by one thread.
    const FORK: usize = 1 << 14;
    let lights = range.lights();
    if lights <= FORK {
        let mut all = Vec::new();
        add_ends(range, first, &mut all);
        return all;
    }
    let (left, right) = range.split();
    let middle = first + left.lights() as u32;
    let (mut all, right) = join(lights, || ends(left, first), || ends(right, middle));
    all.extend(right);
    all
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "a tree holds fewer than 2^32 lights"
)]
fn add_ends(range: MortonRange<'_>, first: u32, ends: &mut Vec<u32>) {
    let lights = range.lights();
    if lights <= CLUSTER {
        ends.push(first + lights as u32);
        return;
    }
    let (left, right) = range.split();
    let middle = first + left.lights() as u32;
    add_ends(left, first, ends);
    add_ends(right, middle, ends);
}

/// The clusters of `primitives` that end at `ends`.
pub(crate) fn clusters(ends: &[u32], primitives: &[LightPrimitive]) -> Vec<Cluster> {
    let mut start = 0;
    let chunks = ends.chunks(CHUNK).map(|ends| {
        let first = start;
        start = ends.last().copied().unwrap_or(first);
        (first, ends)
    });
    let clusters = map(chunks.collect(), |(first, ends): (u32, &[u32])| {
        let starts = core::iter::once(&first).chain(ends);
        let mut clusters = Vec::with_capacity(ends.len());
        for (&start, &end) in starts.zip(ends) {
            let primitives = (start..).zip(&primitives[start as usize..end as usize]);
            clusters.push(Cluster::join(
                primitives.map(|(place, primitive)| Cluster::of_primitive(primitive, place)),
            ));
        }
        clusters
    });
    clusters.concat()
}
