use alloc::vec::Vec;
use core::ops::Range;

use crate::build::cluster::Cluster;
use crate::build::dominant::Dominant;
use crate::build::light_primitive::LightPrimitive;
use crate::build::morton_range::MortonRange;
use crate::build::split_group::SplitGroup;
use crate::parallel::{join, map};

/// Lights of a cluster, at most.
const CLUSTER: usize = 16;

/// How many times the mean power of clusters one has from which on a light that outshines its rest
/// is a cluster of its own. Chosen by V: see `docs/light-bvh-study.md`.
const BRIGHT: f32 = 8.0;

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

/// The clusters of `primitives` that end at `ends`, whose power is a share of that of all lights. A
/// light that outshines a bright one is a cluster of its own.
pub(crate) fn clusters(ends: &[u32], primitives: &[LightPrimitive]) -> Vec<Cluster> {
    let bright = BRIGHT / ends.len() as f32;
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
            let cluster = cluster(start..end, primitives);
            if cluster.power < bright {
                clusters.push(cluster);
                continue;
            }
            let outshines =
                |&place: &u32| Dominant::is_share(power(primitives, place), cluster.power);
            match (start..end).find(outshines) {
                Some(place) => clusters.extend(
                    [start..place, place..place + 1, place + 1..end]
                        .into_iter()
                        .filter(|part| !part.is_empty())
                        .map(|part| self::cluster(part, primitives)),
                ),
                None => clusters.push(cluster),
            }
        }
        clusters
    });
    clusters.concat()
}

fn power(primitives: &[LightPrimitive], place: u32) -> f32 {
    primitives[place as usize].power
}

/// The lights at these places along the curve.
fn cluster(places: Range<u32>, primitives: &[LightPrimitive]) -> Cluster {
    let own = &primitives[places.start as usize..places.end as usize];
    let lights = places.zip(own);
    Cluster::join(lights.map(|(place, primitive)| Cluster::of_primitive(primitive, place)))
}
