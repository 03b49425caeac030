use alloc::vec::Vec;

use light_bounds::LightExtent;
use light_math::Aabb;
use light_math::glam::Vec3;

use crate::LightBvhError;
use crate::build::options::LightBvhOptions;
use crate::light_bvh::LightBvh;
use crate::node::moments::Moments;

/// How many lights of opened placements a tree holds: those of a flat tree of 28 MB.
pub(crate) const MOST_OPENED: usize = 1 << 20;

/// Lights that are placed any number of times and stored once: a tree in coordinates of its own.
#[derive(Clone, Debug)]
pub struct LightPrototype {
    tree: LightBvh,
    /// The lights, for placements that are opened; empty if none is.
    pub(crate) lights: Vec<LightExtent>,
    /// Of all lights together; their power is a share of the tree's.
    pub(crate) moments: Moments,
    /// The middle of the box of all lights; the origin if none is on.
    pub(crate) center: Vec3,
    /// Half of the sum of the sides of that box.
    pub(crate) half_width: f32,
}

impl LightPrototype {
    /// The bounded lights of `lights`, in which the index of an entry is its
    /// [`LightId`](light_bounds::LightId). Lights at infinity have no place in a prototype, and
    /// pmf 0.
    ///
    /// # Errors
    /// As for [`LightBvh::build`].
    pub fn new(lights: &[LightExtent]) -> Result<Self, LightBvhError> {
        Self::with(lights, &LightBvhOptions::default())
    }

    /// The same, built as `options` say.
    ///
    /// # Errors
    /// As for [`LightBvh::build`].
    pub fn with(lights: &[LightExtent], options: &LightBvhOptions) -> Result<Self, LightBvhError> {
        let (tree, moments) = LightBvh::build_with_moments(lights, options)?;
        let lights = if lights.len() <= MOST_OPENED {
            lights.to_vec()
        } else {
            Vec::new()
        };
        Ok(Self::of(tree, lights, moments))
    }

    fn of(tree: LightBvh, lights: Vec<LightExtent>, moments: Moments) -> Self {
        let bounds = &moments.bounds;
        let (center, size) = if bounds.is_empty() {
            (Vec3::ZERO, Vec3::ZERO)
        } else {
            (bounds.center(), bounds.diagonal())
        };
        Self {
            tree,
            lights,
            moments,
            center,
            half_width: 0.5 * size.element_sum(),
        }
    }

    /// Refits the tree: see [`LightBvh::refit`].
    pub(crate) fn refit(&mut self, lights: &[LightExtent]) -> Result<(), LightBvhError> {
        let moments = self.tree.refit_with_moments(lights)?;
        let tree = core::mem::take(&mut self.tree);
        let mut kept = core::mem::take(&mut self.lights);
        if !kept.is_empty() {
            kept.copy_from_slice(lights);
        }
        *self = Self::of(tree, kept, moments);
        Ok(())
    }

    /// The tree of the lights.
    #[must_use]
    pub const fn tree(&self) -> &LightBvh {
        &self.tree
    }

    /// How many lights there are, with those that are off.
    #[must_use]
    pub fn len(&self) -> usize {
        self.tree.slots.len()
    }

    /// Whether there is no light.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.tree.slots.is_empty()
    }

    /// The boxes of the children of the root, which hold all lights that are on.
    pub(crate) fn child_boxes(&self) -> impl Iterator<Item = Aabb> {
        let root = self.tree.nodes.first();
        root.into_iter()
            .flat_map(|root| root.lit_boxes().map(|(_, bounds)| bounds))
    }
}
