use alloc::vec::Vec;
use std::io::{Seek, Write};
use std::path::PathBuf;

use light_bounds::LightExtent;

use crate::build::builder::build;
use crate::build::lights::phi;
use crate::build::options::{DarkLights, LightBvhOptions};
use crate::build::scan::{Scan, expect_addressable, is_held};
use crate::build::topology::low_word;
use crate::light_bvh::rounded;
use crate::node::wide_node::MAX_DEPTH;
use crate::out_of_core::cells::Cells;
use crate::out_of_core::error::OutOfCoreError;
use crate::out_of_core::group::Group;
use crate::out_of_core::light_chunks::LightChunks;
use crate::out_of_core::tree_writer::{TreeWriter, UpperTree};

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
    /// How many lights are in memory at once unless it is said: some 800 MB.
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

    /// The same with at most so many lights in memory at once, at least 1; about 200 bytes for
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
        let tree = self.upper_tree(groups, scan.power)?;
        let mut writer = TreeWriter::new(out, count, &scan, self.options)?;
        writer.write(tree, &mut |n| progress(BuildStage::Build, n))?;
        let power = rounded(scan.power);
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
        let count = each_chunk(lights, |first, chunk| {
            let scan = Scan::new(chunk, first, self.options.dark, &|_, _| Ok(()))?;
            all = all.union(&scan);
            progress(first as usize + chunk.len());
            Ok(())
        })?;
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
        let again = each_chunk(lights, |first, chunk| {
            for (id, light) in (first..).zip(chunk) {
                if light.bounded().is_some() && is_held(phi(light), self.options.dark) {
                    cells.add(&mut groups, id, light)?;
                }
            }
            progress(first as usize + chunk.len());
            Ok(())
        })?;
        let groups = cells.finish(groups)?;
        let held: usize = groups.iter().map(|group| group.sums.scan.count).sum();
        if again == count && held == scan.count {
            Ok(groups)
        } else {
            Err(OutOfCoreError::Changed)
        }
    }

    /// The tree whose lights are `groups`.
    fn upper_tree(&self, groups: Vec<Group>, power: f64) -> Result<UpperTree, OutOfCoreError> {
        let extents: Vec<LightExtent> = groups.iter().map(|group| group.sums.extent()).collect();
        let options = LightBvhOptions {
            dark: DarkLights::Kept,
            ..self.options
        };
        let scan = Scan {
            power,
            ..Scan::new(&extents, 0, options.dark, &|_, _| Ok(()))?
        };
        let (topology, order) = build(&extents, &scan, &options, Self::LEVELS_BELOW);
        let mut groups: Vec<Option<Group>> = groups.into_iter().map(Some).collect();
        Ok(UpperTree {
            nodes: topology.nodes(),
            groups: order.iter().map(|&k| groups[k as usize].take()).collect(),
        })
    }
}

/// Calls `each` with all chunks and the id of the first light of each; how many lights there are.
fn each_chunk(
    lights: &mut impl LightChunks,
    mut each: impl FnMut(u32, &[LightExtent]) -> Result<(), OutOfCoreError>,
) -> Result<usize, OutOfCoreError> {
    let mut chunk = Vec::new();
    let mut first = 0;
    loop {
        chunk.clear();
        lights.next_chunk(&mut chunk)?;
        if chunk.is_empty() {
            return Ok(first);
        }
        let id = low_word(first);
        first += chunk.len();
        expect_addressable(first)?;
        each(id, &chunk)?;
    }
}
