use alloc::vec;
use alloc::vec::Vec;

use light_bounds::LightExtent;

use super::clusters::{clusters, ends};
use super::group::{Children, Group, is_tight};
use super::lights::Lights;
use super::moments::Moments;
use super::morton::{self, Range};
use super::node::{WIDTH, WideNode};
use super::options::{BuildMode, LightBvhOptions};
use super::run::{Run, Sources};
use super::scan::Scan;
use super::subtree::Subtree;
use super::tree::MAX_DEPTH;
use crate::join::map;

/// Lights below which a subtree is made in one go.
const PLOT: usize = 2048;

/// A group that may be so large that its parts are built side by side.
pub(super) trait Crowd: Group {
    /// Builds the whole subtree in one go.
    fn plant(self, plot: Plot<'_>) -> Subtree;
}

impl Crowd for Range<'_> {
    fn plant(self, plot: Plot<'_>) -> Subtree {
        plot.grow(self)
    }
}

/// The nodes of the tree of `lights`, the root first, and the lights in the order that the nodes refer to.
pub(super) fn build(
    extents: &[LightExtent],
    scan: &Scan,
    options: &LightBvhOptions,
) -> (Vec<WideNode>, Vec<u32>) {
    let mut order = vec![0; scan.count];
    if scan.count == 0 {
        return (Vec::new(), order);
    }
    let lights = Lights::new(extents, scan.power);
    let (mut entries, cell) = morton::sorted(extents, &lights, &scan.centers, options.dark);
    let whole = Range::new(&mut entries, &lights, cell);
    let plot = Plot {
        order: &mut order,
        first: 0,
        depth: 0,
    };
    let tree = match options.mode {
        BuildMode::Morton => plot.build(whole),
        BuildMode::Binned => {
            let ends = ends(whole, 0);
            let sources = Sources {
                lights: &lights,
                entries: &entries,
            };
            plot.build(Run::new(&mut clusters(&ends, &sources), sources))
        }
    };
    (tree.into_nodes(), order)
}

/// Where a group goes.
pub(super) struct Plot<'o> {
    /// Room for the ids of its lights.
    order: &'o mut [u32],
    /// The place of that in the whole tree's.
    first: usize,
    /// Levels above it.
    depth: usize,
}

impl<'o> Plot<'o> {
    /// The subtree over a group of any size.
    fn build<C: Crowd>(self, crowd: C) -> Subtree {
        let levels = MAX_DEPTH - self.depth;
        if crowd.lights() <= PLOT || is_tight(crowd.lights(), levels) {
            return crowd.plant(self);
        }
        let children = Children::new(crowd, levels);
        let (mut node, rest) = self.node(&children);
        let jobs = rest.share(children.into_nodes()).collect();
        let subtrees = map(jobs, |(group, plot): (C, Plot<'_>)| plot.build(group));
        for (slot, subtree) in subtrees.iter().enumerate() {
            node.moments[slot] = subtree.moments;
        }
        Subtree::join(node.encode(), Moments::join(node.moments()), subtrees)
    }

    /// The subtree over a group that is built in one go.
    pub(super) fn grow<G: Group>(self, group: G) -> Subtree {
        let mut nodes = Vec::with_capacity(group.lights() / 4 + 1);
        nodes.push(WideNode::EMPTY);
        let moments = self.grow_at(0, group, &mut nodes);
        Subtree::grown(nodes, moments)
    }

    /// Grows the subtree of the node at `index` of `nodes`.
    fn grow_at<G: Group>(self, index: usize, group: G, nodes: &mut Vec<WideNode>) -> Moments {
        let children = Children::new(group, MAX_DEPTH - self.depth);
        let (mut node, rest) = self.node(&children);
        let base = nodes.len();
        nodes.resize(base + node.inner, WideNode::EMPTY);
        for (slot, (group, plot)) in rest.share(children.into_nodes()).enumerate() {
            node.moments[slot] = plot.grow_at(base + slot, group, nodes);
            nodes[base + slot].parent = low_word(index * WIDTH + slot);
        }
        nodes[index] = WideNode {
            child_base: low_word(base),
            parent: nodes[index].parent,
            ..node.encode()
        };
        Moments::join(node.moments())
    }

    /// The node over `children` as far as its lights go, and the room that is left for what is below.
    fn node<G: Group>(self, children: &Children<G>) -> (Draft, Self) {
        let (own, order) = self.order.split_at_mut(children.lights());
        let inner = children.nodes();
        let mut draft = Draft {
            moments: [Moments::NOTHING; WIDTH],
            inner,
            count: inner + own.len(),
            first: self.first,
        };
        let mut places = own.iter_mut().zip(&mut draft.moments[inner..]);
        children.each_light(&mut |light, moments| {
            if let Some((entry, place)) = places.next() {
                (*entry, *place) = (light, moments);
            }
        });
        let rest = Plot {
            first: self.first + own.len(),
            order,
            depth: self.depth + 1,
        };
        (draft, rest)
    }

    /// Each group with its part of the room.
    fn share<G: Group>(self, groups: impl Iterator<Item = G>) -> impl Iterator<Item = (G, Self)> {
        let (mut order, mut first) = (self.order, self.first);
        groups.map(move |group| {
            let (mine, rest) = core::mem::take(&mut order).split_at_mut(group.lights());
            let plot = Plot {
                first,
                order: mine,
                depth: self.depth,
            };
            first += group.lights();
            order = rest;
            (group, plot)
        })
    }
}

/// A node in the making.
struct Draft {
    moments: [Moments; WIDTH],
    /// How many children are nodes; they come first.
    inner: usize,
    count: usize,
    /// The place of the first of its lights.
    first: usize,
}

impl Draft {
    fn moments(&self) -> &[Moments] {
        &self.moments[..self.count]
    }

    fn encode(&self) -> WideNode {
        WideNode {
            inner: low_byte(self.inner),
            light_base: low_word(self.first),
            ..WideNode::encode(self.moments())
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "a tree holds fewer than 2^32 lights, and fewer nodes than lights"
)]
pub(super) const fn low_word(x: usize) -> u32 {
    x as u32
}

#[expect(clippy::cast_possible_truncation, reason = "at most eight children")]
const fn low_byte(x: usize) -> u8 {
    x as u8
}
