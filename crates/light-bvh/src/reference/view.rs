use core::fmt;

use light_bounds::LightId;
use light_bounds::light_math::Aabb;

use super::{BitTrail, Link, ReferenceNode, Side};

/// The tree on borrowed memory: all that sampling needs, without an allocator.
///
/// A query costs one importance per child and level: `2 log2(n)` of them for `n` lights, and no
/// more than 62.
#[derive(Clone, Copy, Debug)]
pub struct ReferenceLightBvhRef<'a> {
    pub(super) nodes: &'a [ReferenceNode],
    pub(super) trails: &'a [BitTrail],
    pub(super) bounds: &'a Aabb,
}

/// Nodes and trails do not belong together, or the nodes are no tree in depth-first order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MalformedTree;

impl fmt::Display for MalformedTree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the nodes are no tree, or the trails do not lead to its leaves")
    }
}

impl core::error::Error for MalformedTree {}

impl<'a> ReferenceLightBvhRef<'a> {
    /// The tree of the given parts, as another tree returned them; one trail per light, in the
    /// order of ids.
    ///
    /// # Errors
    /// If any walk over the nodes could leave them or not end, or a trail does not lead to its
    /// light. Looks at every node once.
    pub fn new(
        nodes: &'a [ReferenceNode],
        trails: &'a [BitTrail],
        bounds: &'a Aabb,
    ) -> Result<Self, MalformedTree> {
        let mut leaves = 0;
        visit_leaves(nodes, |light, trail| {
            leaves += 1;
            trails.get(light.index()) == Some(&trail)
        })?;
        let in_tree = trails.iter().filter(|t| **t != BitTrail::NONE).count();
        if in_tree != leaves {
            return Err(MalformedTree);
        }
        Ok(Self {
            nodes,
            trails,
            bounds,
        })
    }

    /// The nodes in depth-first order; none if no light has power.
    #[must_use]
    pub const fn nodes(&self) -> &'a [ReferenceNode] {
        self.nodes
    }

    /// The trail of each light, in the order of ids.
    #[must_use]
    pub const fn trails(&self) -> &'a [BitTrail] {
        self.trails
    }

    /// The box of all lights in the tree, to which the nodes are relative.
    #[must_use]
    pub const fn bounds(&self) -> &'a Aabb {
        self.bounds
    }

    /// Whether no light is in the tree.
    #[inline]
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}

/// Calls `visit` with every leaf and its trail, in depth-first order, until it returns false.
///
/// # Errors
/// If the nodes are not a tree in depth-first order, or `visit` returned false.
pub(super) fn visit_leaves(
    nodes: &[ReferenceNode],
    mut visit: impl FnMut(LightId, BitTrail) -> bool,
) -> Result<(), MalformedTree> {
    if nodes.is_empty() {
        return Ok(());
    }
    // Second children that are still to come: one a level at most.
    let mut pending = [(0u32, BitTrail::NONE); BitTrail::MAX_DEPTH as usize];
    let mut pending_count = 0;
    let mut trail = BitTrail::ROOT;
    for (index, node) in nodes.iter().enumerate() {
        match node.link() {
            Link::Interior { second_child } => {
                let (Some(first), Some(second)) =
                    (trail.then(Side::First), trail.then(Side::Second))
                else {
                    return Err(MalformedTree);
                };
                pending[pending_count] = (second_child, second);
                pending_count += 1;
                trail = first;
            }
            Link::Leaf(light) => {
                if !visit(light, trail) {
                    return Err(MalformedTree);
                }
                if pending_count == 0 {
                    return if index + 1 == nodes.len() {
                        Ok(())
                    } else {
                        Err(MalformedTree)
                    };
                }
                pending_count -= 1;
                let (next, next_trail) = pending[pending_count];
                if next as usize != index + 1 {
                    return Err(MalformedTree);
                }
                trail = next_trail;
            }
        }
    }
    Err(MalformedTree)
}
