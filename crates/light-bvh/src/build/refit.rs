use light_bounds::LightExtent;

use crate::LightBvhError;
use crate::build::lights::{LeafMoments, phi};
use crate::build::options::DarkLights;
use crate::build::scan::Scan;
use crate::node::moments::Moments;
use crate::node::wide_node::{NOWHERE, WIDTH, WideNode};
use crate::parallel::{is_worth_a_thread, join};

/// A subtree of at most so many lights reads all of them first.
const BATCH: usize = 128;

/// Validates the lights of a refit; `slots` say which of them are in the tree.
///
/// # Errors
/// The first light with invalid bounds, or one that has no place in the tree.
pub(crate) fn scan(lights: &[LightExtent], slots: &[u32]) -> Result<Scan, LightBvhError> {
    Scan::new(lights, 0, DarkLights::Kept, &|light, extent| {
        let is_in_tree = slots
            .get(light.index())
            .is_some_and(|&slot| slot != NOWHERE);
        let fits = match extent {
            LightExtent::Bounded(_) | LightExtent::Lobe(..) => is_in_tree || phi(extent) == 0.0,
            LightExtent::Infinite(_) => !is_in_tree,
        };
        if fits {
            Ok(())
        } else {
            Err(LightBvhError::NoPlace { light })
        }
    })
}

/// Encodes the moments of all nodes, whose places are set; returns those of all `lights` together.
///
/// The root is node `first`; `order` ends with the lights of these nodes.
pub(crate) fn fill<L: LeafMoments>(
    nodes: &mut [WideNode],
    first: usize,
    order: &[u32],
    lights: &L,
) -> Moments {
    let filling = Filling { lights, order };
    let room = &mut [Moments::NOTHING; BATCH];
    match nodes.split_first_mut() {
        Some((root, below)) => filling.subtree(root, below, first + 1, order.len(), room),
        None => Moments::NOTHING,
    }
}

/// The lights and their order.
struct Filling<'a, L> {
    lights: &'a L,
    order: &'a [u32],
}

/// Room for the moments of a batch, used again and again.
type Room = [Moments; BATCH];

impl<L: LeafMoments> Filling<'_, L> {
    /// Fills a subtree, whose lights end at place `end` of the order. `below` are the nodes below
    /// `node`, and perhaps more; `base` is the place of the first of them in the tree.
    fn subtree(
        &self,
        node: &mut WideNode,
        below: &mut [WideNode],
        base: usize,
        end: usize,
        room: &mut Room,
    ) -> Moments {
        let first = node.light_base as usize;
        let lights = &self.order[first..end];
        if lights.len() <= BATCH {
            // Lights are far from each other in memory: those of the next batch are prefetched
            // while these are read.
            let later = self.order.get(first + BATCH..).unwrap_or_default();
            let mut later = later.iter();
            for (moments, &light) in room.iter_mut().zip(lights) {
                if let Some(&light) = later.next() {
                    self.lights.prefetch(light);
                }
                *moments = self.lights.moments(light);
            }
            return Batch {
                moments: room,
                first,
            }
            .subtree(node, below, base);
        }
        let inner = usize::from(node.inner);
        let mut moments = [Moments::NOTHING; WIDTH];
        let own = node.children() - inner;
        for (own, &light) in moments[inner..].iter_mut().zip(&lights[..own]) {
            *own = self.lights.moments(light);
        }
        let (children, rest) = below.split_at_mut(inner);
        self.side_by_side(
            children,
            rest,
            base + inner,
            end,
            room,
            &mut moments[..inner],
        );
        encode(node, &moments)
    }

    /// The same for nodes side by side; `below` are the nodes below all of them, in their order.
    fn side_by_side(
        &self,
        nodes: &mut [WideNode],
        below: &mut [WideNode],
        base: usize,
        end: usize,
        room: &mut Room,
        moments: &mut [Moments],
    ) {
        match nodes {
            [] => {}
            [node] => moments[0] = self.subtree(node, below, base, end, room),
            _ => {
                let middle = nodes.len() / 2;
                let lights = end - nodes[0].light_base as usize;
                let (nodes, later) = nodes.split_at_mut(middle);
                // What is below the second half begins at the children of its first node.
                let border = later[0].child_base as usize;
                let light_border = later[0].light_base as usize;
                let (below, below_later) = below.split_at_mut(border - base);
                let (moments, moments_later) = moments.split_at_mut(middle);
                let mut first = |room: &mut Room| {
                    self.side_by_side(nodes, below, base, light_border, room, moments);
                };
                let mut second = |room: &mut Room| {
                    self.side_by_side(later, below_later, border, end, room, moments_later);
                };
                if is_worth_a_thread(lights) {
                    let mut room_later = [Moments::NOTHING; BATCH];
                    join(lights, || first(room), || second(&mut room_later));
                } else {
                    first(room);
                    second(room);
                }
            }
        }
    }
}

/// The moments of some lights that follow each other in the order.
struct Batch<'a> {
    moments: &'a [Moments],
    /// The place of the first.
    first: usize,
}

impl Batch<'_> {
    /// Encodes a subtree of which all lights are in the batch, as [`Filling::subtree`] does.
    fn subtree(&self, node: &mut WideNode, below: &mut [WideNode], base: usize) -> Moments {
        let (inner, count) = (usize::from(node.inner), node.children());
        let child_base = node.child_base as usize;
        let mut moments = [Moments::NOTHING; WIDTH];
        let own = &self.moments[node.light_base as usize - self.first..][..count - inner];
        moments[inner..count].copy_from_slice(own);
        let (children, rest) = below[child_base - base..].split_at_mut(inner);
        for (of_child, child) in moments.iter_mut().zip(children) {
            *of_child = self.subtree(child, rest, child_base + inner);
        }
        encode(node, &moments)
    }
}

/// Encodes the first of `children`, as many as `node` has, and returns the moments of all of them.
fn encode(node: &mut WideNode, children: &[Moments; WIDTH]) -> Moments {
    node.encode_children(&children[..node.children()])
}
