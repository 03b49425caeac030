use light_bounds::{CompactLightBounds, LightId};

/// Set in the link of a leaf.
const LEAF_BIT: u32 = 1 << 31;

/// One node of the tree, 32 bytes and aligned to them, so that it never crosses a cache line.
///
/// Nodes are in depth-first order: the first child follows its parent, [`Link`] names the second.
///
/// ```
/// # use light_bvh::light_bounds::LightId;
/// # use light_bvh::reference::{Link, ReferenceNode};
/// /// The light that is reached from the root by taking the second child where `second` says so.
/// fn reach(nodes: &[ReferenceNode], second: impl Fn(usize) -> bool) -> LightId {
///     let mut index = 0;
///     loop {
///         match nodes[index].link() {
///             Link::Leaf(light) => return light,
///             Link::Interior { second_child } if second(index) => index = second_child as usize,
///             Link::Interior { .. } => index += 1,
///         }
///     }
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(C, align(32))]
pub struct ReferenceNode {
    bounds: CompactLightBounds,
    /// The light of a leaf with [`LEAF_BIT`], else the index of the second child.
    link: u32,
    /// Zero: fills the node to 32 bytes.
    spare: u32,
}

const _: () = assert!(size_of::<ReferenceNode>() == 32, "32 bytes");
const _: () = assert!(align_of::<ReferenceNode>() == 32, "one a half line");

impl ReferenceNode {
    /// Lights and nodes are numbered below this.
    #[cfg(feature = "alloc")]
    pub(crate) const INDEX_LIMIT: u32 = LEAF_BIT;

    /// The leaf of `light`, whose id is below 2^31.
    #[must_use]
    pub fn leaf(bounds: CompactLightBounds, light: LightId) -> Self {
        debug_assert!(light.0 < LEAF_BIT, "31 bits");
        Self {
            bounds,
            link: light.0 | LEAF_BIT,
            spare: 0,
        }
    }

    /// A node above others; the index of its second child is below
    /// 2^31.
    #[must_use]
    pub fn interior(bounds: CompactLightBounds, second_child: u32) -> Self {
        debug_assert!(second_child < LEAF_BIT, "31 bits");
        Self {
            bounds,
            link: second_child,
            spare: 0,
        }
    }

    /// Bounds of all lights below, relative to the box of the whole tree.
    #[inline]
    #[must_use]
    pub const fn bounds(&self) -> &CompactLightBounds {
        &self.bounds
    }

    /// What is below.
    #[inline]
    #[must_use]
    pub const fn link(&self) -> Link {
        if self.link & LEAF_BIT == 0 {
            Link::Interior {
                second_child: self.link,
            }
        } else {
            Link::Leaf(LightId(self.link & !LEAF_BIT))
        }
    }
}

/// What a node leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// Two children: the one behind the node itself, and this one.
    Interior {
        /// Index of the second child.
        second_child: u32,
    },
    /// One light.
    Leaf(LightId),
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_bounds::LightBounds;
    use light_bounds::light_math::{Aabb, glam::Vec3};

    #[test]
    fn links() {
        let point = Aabb::from_point(Vec3::ZERO);
        let bounds = LightBounds {
            bounds: point,
            ..LightBounds::EMPTY
        };
        let bounds = CompactLightBounds::encode(&bounds, &point);
        let leaf = ReferenceNode::leaf(bounds, LightId(7));
        assert_eq!(leaf.link(), Link::Leaf(LightId(7)), "a light");
        let interior = ReferenceNode::interior(bounds, 7);
        assert_eq!(
            interior.link(),
            Link::Interior { second_child: 7 },
            "a child"
        );
        assert_eq!(*interior.bounds(), bounds, "as given");
    }
}
