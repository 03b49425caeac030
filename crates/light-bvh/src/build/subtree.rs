use alloc::vec::Vec;

use crate::build::node_children::{Children, is_tight};
use crate::build::split_group::Group;
use crate::build::topology::{Fan, Skeleton};
use crate::node::wide_node::MAX_DEPTH;
use crate::parallel::map;

/// A group that may be so large that its parts are built side by side.
pub(crate) trait Crowd: Group {
    /// A group of no more lights is built in one go.
    const PLOT: usize;

    /// Builds the whole subtree in one go.
    fn plant(self, plot: Plot<'_>) -> Skeleton;
}

/// Where a group goes.
pub(crate) struct Plot<'o> {
    /// Room for the ids of its lights.
    pub(crate) order: &'o mut [u32],
    /// Levels above it.
    pub(crate) depth: usize,
}

impl<'o> Plot<'o> {
    /// The subtree over a group of any size.
    pub(crate) fn build<C: Crowd>(self, crowd: C) -> Skeleton {
        let levels = MAX_DEPTH - self.depth;
        if crowd.lights() <= C::PLOT || is_tight(crowd.lights(), levels) {
            return crowd.plant(self);
        }
        let children = Children::new(crowd, levels);
        let (root, rest) = self.node(&children);
        let jobs = rest.share(children.into_nodes()).collect();
        let subtrees = map(jobs, |(group, plot): (C, Plot<'_>)| plot.build(group));
        Skeleton::join(root, &subtrees)
    }

    /// The subtree over a group that is built in one go.
    pub(crate) fn grow<G: Group>(self, group: G) -> Skeleton {
        let mut fans = Vec::with_capacity(group.lights() / 4 + 1);
        fans.push(Fan::default());
        self.grow_at(0, group, &mut fans);
        Skeleton(fans)
    }

    /// Grows the subtree of the node at `index` of `fans`.
    fn grow_at<G: Group>(self, index: usize, group: G, fans: &mut Vec<Fan>) {
        let children = Children::new(group, MAX_DEPTH - self.depth);
        let (fan, rest) = self.node(&children);
        fans[index] = fan;
        let base = fans.len();
        fans.resize(base + usize::from(fan.inner), Fan::default());
        for (child, (group, plot)) in (base..).zip(rest.share(children.into_nodes())) {
            plot.grow_at(child, group, fans);
        }
    }

    /// The node over `children`, whose lights are put into their places, and the room that is left for what is below.
    fn node<G: Group>(self, children: &Children<G>) -> (Fan, Self) {
        let (own, order) = self.order.split_at_mut(children.lights());
        let fan = Fan {
            inner: low_byte(children.nodes()),
            count: low_byte(children.nodes() + own.len()),
        };
        let mut places = own.iter_mut();
        children.each_light(|light| {
            if let Some(place) = places.next() {
                *place = light;
            }
        });
        let depth = self.depth + 1;
        (fan, Plot { order, depth })
    }

    /// Each group with its part of the room.
    fn share<G: Group>(self, groups: impl Iterator<Item = G>) -> impl Iterator<Item = (G, Self)> {
        let (mut order, depth) = (self.order, self.depth);
        groups.map(move |group| {
            let (mine, rest) = core::mem::take(&mut order).split_at_mut(group.lights());
            order = rest;
            (group, Plot { order: mine, depth })
        })
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "at most as many children as a node has slots"
)]
const fn low_byte(x: usize) -> u8 {
    x as u8
}
