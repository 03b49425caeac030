//! Which placements are opened: those that reach into others.

use alloc::vec::Vec;
use core::cmp::Reverse;

use light_math::Aabb;
use light_math::glam::Vec3;

use crate::build::topology::low_word;
use crate::instances::placed::Placed;
use crate::light_bvh::LightBvh;
use crate::parallel::table;

/// Of how many parts of others a placement is told apart by how many of them it reaches into.
const MOST_COUNTED: u32 = 16;

/// How many nodes the search for them reads.
const MOST_NODES: u32 = 256;

/// How far two boxes reach into each other, as a share of half the longest side of the smaller one,
/// if they do: neighbours that touch do not.
const LEAST_DEPTH: f32 = 0.125;

/// The placements whose lights become leaves of the upper tree, in ascending order: with `most`
/// lights at most, those first that reach into most parts of others. `closed` is the tree of all.
pub(crate) fn placements_to_open(closed: &LightBvh, placed: &Placed<'_>, most: usize) -> Vec<u32> {
    let lights = |placement: usize| {
        let prototype = placed.placements[placement].prototype;
        placed.prototypes[prototype as usize].lights.len()
    };
    let overlaps = table(placed.placements.len(), |i| {
        let placement = low_word(i);
        let bounds = placed.bounds(placement);
        if !bounds.is_empty() && (1..=most).contains(&lights(i)) {
            Search::of(closed, placed, placement, bounds)
        } else {
            0
        }
    });
    let mut wanted: Vec<_> = (0u32..)
        .zip(overlaps)
        .filter(|&(_, overlaps)| overlaps > 0)
        .map(|(i, overlaps)| (Reverse(overlaps), lights(i as usize), i))
        .collect();
    wanted.sort_unstable();
    let mut opened = Vec::new();
    let mut count = 0;
    for (_, lights, placement) in wanted {
        let more = count + lights;
        if more <= most && placed.ids.fit(placed.placements.len(), more) {
            count = more;
            opened.push(placement);
        }
    }
    opened.sort_unstable();
    opened
}

/// A count of the parts of others that a placement reaches into.
struct Search<'a> {
    tree: &'a LightBvh,
    placed: &'a Placed<'a>,
    placement: u32,
    bounds: Aabb,
    found: u32,
    nodes: u32,
}

impl<'a> Search<'a> {
    /// Into how many parts of others `placement` reaches, as far as they are counted. Its lights
    /// are in `bounds`.
    fn of(tree: &'a LightBvh, placed: &'a Placed<'_>, placement: u32, bounds: Aabb) -> u32 {
        let mut search = Self {
            tree,
            placed,
            placement,
            bounds,
            found: 0,
            nodes: 0,
        };
        search.in_node(0);
        search.found
    }

    fn in_node(&mut self, index: usize) {
        let Some(node) = self.tree.nodes.get(index) else {
            return;
        };
        self.nodes += 1;
        for (k, child) in node.lit_boxes() {
            if self.found >= MOST_COUNTED || self.nodes >= MOST_NODES {
                return;
            }
            if !overlap(&self.bounds, &child) {
                continue;
            }
            if let Some(light) = k.checked_sub(usize::from(node.inner)) {
                let other = self.tree.order[node.light_base as usize + light];
                let is_other = self.placed.ids.part(other).0 != self.placement;
                let bounds = self.placed.groups[other as usize].bounds();
                let reaches = overlap(&self.bounds, bounds);
                self.found += u32::from(is_other && reaches);
            } else {
                self.in_node(node.child_base as usize + k);
            }
        }
    }
}

/// Whether boxes reach into each other.
fn overlap(a: &Aabb, b: &Aabb) -> bool {
    let apart = (a.center() - b.center()).abs();
    let [half_a, half_b] = [a, b].map(|bounds| 0.5 * bounds.diagonal());
    let depth = LEAST_DEPTH * half_a.max_element().min(half_b.max_element());
    // Of boxes that are flat alike only those in one plane do.
    let reach = (half_a + half_b - depth).max(Vec3::ZERO);
    apart.cmple(reach).all()
}
