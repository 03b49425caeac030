use alloc::vec;
use alloc::vec::Vec;

use light_bounds::LightExtent;

use crate::build::binned_split::BinnedSplit;
use crate::build::clustering::{clusters, ends};
use crate::build::light_primitive::LightPrimitive;
use crate::build::lights::{LeafMoments, Lights};
use crate::build::morton;
use crate::build::morton_range::MortonRange;
use crate::build::options::{BuildMode, LightBvhOptions};
use crate::build::scan::Scan;
use crate::build::subtree::{OutputSlice, ParallelGroup};
use crate::build::topology::Topology;
use crate::parallel::table;

/// The shape of the tree of `extents`, and these in the order that its nodes refer to; `depth`
/// levels are, or will be, above its root.
pub(crate) fn build(
    extents: &[LightExtent],
    scan: &Scan,
    options: &LightBvhOptions,
    depth: usize,
) -> (Topology, Vec<u32>) {
    let mut order = vec![0; scan.count];
    if scan.count == 0 {
        return (Topology(Vec::new()), order);
    }
    /// Sets of at most this many lights are split light by light from the root on: clusters would
    /// be too coarse.
    const FEW: usize = 2048;
    /// How many lights ahead of the one that is read are prefetched.
    const AHEAD: usize = 24;
    let lights = Lights::new(extents, scan.power);
    let (mut entries, cell) = morton::sorted(extents, &lights, &scan.centers, options.dark);
    let whole = MortonRange::new(&mut entries, &lights, cell);
    let output = OutputSlice {
        order: &mut order,
        depth,
    };
    let tree = match options.mode {
        BuildMode::Morton => output.build(whole),
        BuildMode::Binned => {
            let ends = ends(whole, 0);
            let primitives = table(entries.len(), |i| {
                let entry = &entries[i];
                if let Some(later) = entries.get(i + AHEAD) {
                    lights.prefetch(later.light);
                }
                LightPrimitive::new(entry.light, lights.bounds(entry.light), entry.power)
            });
            let mut clusters = clusters(&ends, &primitives);
            let whole = BinnedSplit::new(&mut clusters, &primitives);
            if primitives.len() <= FEW {
                whole.build_subtree(output)
            } else {
                output.build(whole)
            }
        }
    };
    (tree, order)
}
