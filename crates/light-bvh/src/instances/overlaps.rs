//! Which placements are opened: those that reach into others.

use alloc::vec::Vec;
use core::cmp::Reverse;

use light_math::Aabb;
use light_math::glam::Vec3;

use crate::build::scan::is_addressable;
use crate::instances::placed::Placed;
use crate::instances::placed_moments::PlacedGroup;
use crate::light_bvh::LightBvh;
use crate::parallel::table;

/// Of how many placements a placement is told apart by how many of them it reaches into.
const MOST_COUNTED: u32 = 16;

/// How many nodes the search for them reads.
const MOST_NODES: u32 = 256;

/// How far two boxes reach into each other, as a share of half the longest side of the smaller one,
/// if they do: neighbours that touch do not.
const LEAST_DEPTH: f32 = 0.125;

/// The placements whose lights become leaves of the upper tree, in ascending order: with `most`
/// lights at most, those first that reach into most others. `closed` is the tree of all placements.
pub(crate) fn placements_to_open(closed: &LightBvh, placed: &Placed<'_>, most: usize) -> Vec<u32> {
    let lights = |placement: usize| {
        let prototype = placed.placements[placement].prototype;
        placed.prototypes[prototype as usize].lights.len()
    };
    let overlaps = table(placed.groups.len(), |i| {
        let is_lit = placed.groups[i].power() > 0.0;
        if is_lit && (1..=most).contains(&lights(i)) {
            Search::of(closed, &placed.groups, i)
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
        if more <= most && is_addressable(placed.groups.len() + more) {
            count = more;
            opened.push(placement);
        }
    }
    opened.sort_unstable();
    opened
}

/// A count of the placements that one reaches into.
struct Search<'a> {
    tree: &'a LightBvh,
    groups: &'a [PlacedGroup],
    placement: usize,
    found: u32,
    nodes: u32,
}

impl<'a> Search<'a> {
    /// Into how many others `placement` reaches, as far as they are counted.
    fn of(tree: &'a LightBvh, groups: &'a [PlacedGroup], placement: usize) -> u32 {
        let mut search = Self {
            tree,
            groups,
            placement,
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
        let bounds = *self.groups[self.placement].bounds();
        for (k, child) in node.lit_boxes() {
            if self.found >= MOST_COUNTED || self.nodes >= MOST_NODES {
                return;
            }
            if !overlap(&bounds, &child) {
                continue;
            }
            if let Some(light) = k.checked_sub(usize::from(node.inner)) {
                let other = self.tree.order[node.light_base as usize + light] as usize;
                let is_other = other != self.placement;
                let reaches = overlap(&bounds, self.groups[other].bounds());
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
