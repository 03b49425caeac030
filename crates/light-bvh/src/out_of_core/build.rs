use alloc::vec::Vec;
use core::mem::swap;
use std::io::{Seek, Write};
use std::path::PathBuf;

use light_bounds::LightExtent;

use crate::build::builder::build;
use crate::build::lights::phi;
use crate::build::options::{DarkLights, LightBvhOptions};
use crate::build::scan::{Scan, expect_addressable, is_held};
use crate::build::topology::low_word;
use crate::light_bvh::saturated;
use crate::node::wide_node::MAX_DEPTH;
use crate::out_of_core::cells::Cells;
use crate::out_of_core::error::OutOfCoreError;
use crate::out_of_core::group::Group;
use crate::out_of_core::light_chunks::LightChunks;
use crate::out_of_core::subtree::{PlacedGroup, Subtree};
use crate::out_of_core::tree_writer::TreeWriter;
use crate::out_of_core::upper_tree::UpperTree;
use crate::parallel::{map, overlap};

/// How a tree of more lights than memory holds is built.
#[derive(Clone, Debug)]
pub struct OutOfCoreBuild {
    scratch: PathBuf,
    options: LightBvhOptions,
    lights_at_once: usize,
}

/// What a build does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BuildStage {
    /// Reads the lights for the first time: how many are known.
    Count,
    /// Reads them for the second time, into scratch files: how many of all.
    Divide,
    /// Builds and writes the tree: how many of those that the tree holds.
    Build,
}

/// What was written.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct OutOfCoreTree {
    /// How many lights were read.
    pub lights: usize,
    /// How many of them the tree holds: neither those at infinity nor, as a rule, dark ones.
    pub held: usize,
    /// How many nodes it has.
    pub nodes: usize,
    /// How many bytes were written.
    pub bytes: u64,
    /// The power of all lights of the tree.
    pub power: f32,
}

impl OutOfCoreBuild {
    /// How many lights are in memory at once unless it is said: at most 1 GB.
    const LIGHTS_AT_ONCE: usize = 1 << 22;

    /// The upper tree has at most half of the levels that a tree may have.
    const LEVELS_BELOW: usize = MAX_DEPTH / 2;

    /// Builds with scratch files in this folder, which exists, about 56 bytes a light. They are
    /// removed at the end, also after an error.
    #[must_use]
    pub fn new(scratch: impl Into<PathBuf>) -> Self {
        Self {
            scratch: scratch.into(),
            options: LightBvhOptions::default(),
            lights_at_once: Self::LIGHTS_AT_ONCE,
        }
    }

    /// The same, built as `options` say.
    #[must_use]
    pub fn with_options(self, options: LightBvhOptions) -> Self {
        Self { options, ..self }
    }

    /// The same with at most so many lights in memory at once, at least 1; about 240 bytes for
    /// each. 2^22 unless it is said.
    #[must_use]
    pub fn with_lights_at_once(self, lights: usize) -> Self {
        Self {
            lights_at_once: lights.max(1),
            ..self
        }
    }

    /// Writes the tree of `lights` from where `out` stands: bytes for
    /// [`StoredLightBvh`](crate::StoredLightBvh), as [`LightBvh::to_bytes`] makes them. Calls
    /// `progress` with what it does and how many lights are done, after each chunk.
    ///
    /// If all lights are in memory at once, the bytes are those of [`LightBvh::build_with`].
    /// Otherwise they depend on how many may be, and not on the number of threads.
    ///
    /// # Errors
    /// Those of [`LightBvh::build_with`]; what cannot be read or written; lights that are not the
    /// same when they are read again.
    ///
    /// [`LightBvh::to_bytes`]: crate::LightBvh::to_bytes
    /// [`LightBvh::build_with`]: crate::LightBvh::build_with
    pub fn write(
        &self,
        lights: &mut impl LightChunks,
        out: &mut (impl Write + Seek),
        mut progress: impl FnMut(BuildStage, usize),
    ) -> Result<OutOfCoreTree, OutOfCoreError> {
        let (count, scan) = self.scan(lights, &mut |n| progress(BuildStage::Count, n))?;
        lights.rewind()?;
        let groups = self.divide(lights, count, &scan, &mut |n| {
            progress(BuildStage::Divide, n);
        })?;
        let (tree, groups) = self.upper_tree(groups, scan.power)?;
        let mut writer = TreeWriter::new(out, count, &scan, tree)?;
        self.build(groups, scan.power, &mut |subtree| {
            writer.add(subtree)?;
            progress(BuildStage::Build, writer.held());
            Ok(())
        })?;
        let power = saturated(scan.power);
        let (nodes, bytes) = writer.finish(power)?;
        Ok(OutOfCoreTree {
            lights: count,
            held: scan.count,
            nodes,
            bytes,
            power,
        })
    }

    /// How many lights there are, and the sums of those that the tree holds.
    fn scan(
        &self,
        lights: &mut impl LightChunks,
        progress: &mut dyn FnMut(usize),
    ) -> Result<(usize, Scan), OutOfCoreError> {
        let mut all = Scan::NOTHING;
        let add = |first, chunk: &[LightExtent]| {
            let scan = Scan::new(chunk, first, self.options.dark, &|_, _| Ok(()))?;
            all = all.union(&scan);
            Ok(())
        };
        let count = each_chunk(lights, add, progress)?;
        Ok((count, all))
    }

    /// The lights in scratch files.
    fn divide(
        &self,
        lights: &mut impl LightChunks,
        count: usize,
        scan: &Scan,
        progress: &mut dyn FnMut(usize),
    ) -> Result<Vec<Group>, OutOfCoreError> {
        let mut cells = Cells::new(&self.scratch, self.lights_at_once);
        let mut groups = cells.begin(scan.count, &scan.centers);
        let add = |first, chunk: &[LightExtent]| {
            for (id, light) in (first..).zip(chunk) {
                if light.bounded().is_some() && is_held(phi(light), self.options.dark) {
                    cells.add(&mut groups, id, light)?;
                }
            }
            Ok(())
        };
        let again = each_chunk(lights, add, progress)?;
        let groups = cells.finish(groups)?;
        let held: usize = groups.iter().map(|group| group.sums.scan.count).sum();
        if again == count && held == scan.count {
            Ok(groups)
        } else {
            Err(OutOfCoreError::Changed)
        }
    }

    /// The tree whose lights are `groups`, and these in the order in which they are written.
    fn upper_tree(
        &self,
        groups: Vec<Group>,
        power: f64,
    ) -> Result<(UpperTree, Vec<PlacedGroup>), OutOfCoreError> {
        let extents: Vec<LightExtent> = groups.iter().map(|group| group.sums.extent()).collect();
        let options = LightBvhOptions {
            dark: DarkLights::Kept,
            ..self.options
        };
        let scan = Scan {
            power,
            ..Scan::of(&extents, options.dark)?
        };
        let (topology, order) = build(&extents, &scan, &options, Self::LEVELS_BELOW);
        let mut groups: Vec<Option<Group>> = groups.into_iter().map(Some).collect();
        let mut placed = Vec::with_capacity(groups.len());
        let tree = UpperTree(topology.nodes());
        tree.for_each_group(&mut |light, depth| {
            let group = groups[order[light] as usize].take();
            placed.extend(group.map(|group| PlacedGroup { group, depth }));
        });
        Ok((tree, placed))
    }

    /// Calls `each` with the trees of all groups, while the next ones are built.
    fn build(
        &self,
        groups: Vec<PlacedGroup>,
        power: f64,
        each: &mut dyn FnMut(Subtree) -> Result<(), OutOfCoreError>,
    ) -> Result<(), OutOfCoreError> {
        let mut groups = groups.into_iter().peekable();
        let mut next_batch = || {
            let mut batch = Vec::new();
            let mut room = self.lights_at_once / 2;
            while let Some(placed) =
                groups.next_if(|placed| batch.is_empty() || placed.count() <= room)
            {
                room = room.saturating_sub(placed.count());
                batch.push(placed);
            }
            batch
        };
        let build = |batch| {
            map(batch, |placed: PlacedGroup| {
                placed.build(&self.options, power)
            })
        };
        let mut ready = build(next_batch());
        while !ready.is_empty() {
            let batch = next_batch();
            let mut next = Vec::new();
            overlap(
                || next = build(batch),
                || ready.into_iter().try_for_each(|subtree| each(subtree?)),
            )?;
            ready = next;
        }
        Ok(())
    }
}

/// Calls `each` with all chunks and the id of the first light of each, while the next one is read,
/// and then `progress` with the number of lights so far; how many lights there are.
fn each_chunk(
    lights: &mut impl LightChunks,
    mut each: impl FnMut(u32, &[LightExtent]) -> Result<(), OutOfCoreError> + Send,
    progress: &mut dyn FnMut(usize),
) -> Result<usize, OutOfCoreError> {
    let (mut chunk, mut next) = (Vec::new(), Vec::new());
    let mut count = 0;
    lights.next_chunk(&mut chunk)?;
    while !chunk.is_empty() {
        let first = low_word(count);
        count += chunk.len();
        expect_addressable(count)?;
        next.clear();
        let mut done = Ok(());
        let read = overlap(
            || done = each(first, &chunk),
            || lights.next_chunk(&mut next),
        );
        done?;
        read?;
        progress(count);
        swap(&mut chunk, &mut next);
    }
    Ok(count)
}
