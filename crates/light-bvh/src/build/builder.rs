use alloc::vec;
use alloc::vec::Vec;

use light_bounds::LightExtent;

use crate::build::binned_split::Run;
use crate::build::clustering::{clusters, ends};
use crate::build::light_primitive::Lamp;
use crate::build::lights::Lights;
use crate::build::morton;
use crate::build::morton_range::Range;
use crate::build::options::{BuildMode, LightBvhOptions};
use crate::build::scan::Scan;
use crate::build::subtree::{Crowd, Plot};
use crate::build::topology::Skeleton;
use crate::parallel::table;

/// The shape of the tree of `lights`, and these in the order that its nodes refer to.
pub(crate) fn build(
    extents: &[LightExtent],
    scan: &Scan,
    options: &LightBvhOptions,
) -> (Skeleton, Vec<u32>) {
    let mut order = vec![0; scan.count];
    if scan.count == 0 {
        return (Skeleton(Vec::new()), order);
    }
    /// So few lights are split one by one from the root on: clusters of them would be too coarse.
    const FEW: usize = 2048;
    /// So many lights are on their way from memory while one is read.
    const AHEAD: usize = 24;
    let lights = Lights::new(extents, scan.power);
    let (mut entries, cell) = morton::sorted(extents, &lights, &scan.centers, options.dark);
    let whole = Range::new(&mut entries, &lights, cell);
    let plot = Plot {
        order: &mut order,
        depth: 0,
    };
    let tree = match options.mode {
        BuildMode::Morton => plot.build(whole),
        BuildMode::Binned => {
            let ends = ends(whole, 0);
            let lamps = table(entries.len(), |i| {
                let entry = &entries[i];
                if let Some(later) = entries.get(i + AHEAD) {
                    lights.prefetch(later.light);
                }
                Lamp::new(entry.light, lights.bounds(entry.light), entry.power)
            });
            let mut clusters = clusters(&ends, &lamps);
            let run = Run::new(&mut clusters, &lamps);
            if lamps.len() <= FEW {
                run.plant(plot)
            } else {
                plot.build(run)
            }
        }
    };
    (tree, order)
}
