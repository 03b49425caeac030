use alloc::vec;
use alloc::vec::Vec;

use light_bounds::{LightExtent, LightId};
use light_math::Aabb;
use light_math::glam::Vec3;

use crate::LightBvhError;
use crate::build::lights::{Lights, phi};
use crate::build::options::{DarkLights, LightBvhOptions};
use crate::build::scan::{Scan, expect_addressable, is_held, not_held};
use crate::instances::by_direction;
use crate::instances::part::Part;
use crate::light_bvh::LightBvh;
use crate::node::wide_node::NOWHERE;
use crate::query::bvh_ref::LightBvhRef;

/// How many lights of opened placements a tree holds: those of a flat tree of 28 MB.
pub(crate) const MOST_OPENED: usize = 1 << 20;

/// Lights that are placed any number of times and stored once, in coordinates of their own: a tree,
/// or one for each face of a box.
///
/// Each of these parts is a leaf of the tree of trees wherever the prototype is placed. Lights are
/// divided where they emit in two to six directions, and face outward: each wall of a house is a
/// part.
#[derive(Clone, Debug)]
pub struct LightPrototype {
    /// The trees of all parts, one behind the other.
    trees: LightBvh,
    /// At least one.
    parts: Vec<Part>,
    /// The lights, for placements that are opened; empty if none is.
    pub(crate) lights: Vec<LightExtent>,
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
        Self::with_options(lights, &LightBvhOptions::default())
    }

    /// The same, built as `options` say.
    ///
    /// # Errors
    /// As for [`LightBvh::build`].
    pub fn with_options(
        lights: &[LightExtent],
        options: &LightBvhOptions,
    ) -> Result<Self, LightBvhError> {
        expect_addressable(lights.len())?;
        let all = Scan::of(lights, options.dark)?;
        let numbers = by_direction::parts(lights, |light| {
            light.bounded().is_some() && is_held(phi(light), options.dark)
        });
        let mut trees = LightBvh {
            slots: vec![NOWHERE; lights.len()],
            ..LightBvh::default()
        };
        let mut parts = Vec::new();
        match numbers.iter().max() {
            None => parts.push(Part::build(&mut trees, lights, &all, options)),
            Some(&last) => {
                for part in 0..=last {
                    let own = alone(lights, |light| numbers[light] == part);
                    let sums = Scan::of(&own, options.dark)?;
                    parts.push(Part::build(&mut trees, &own, &sums, options));
                }
            }
        }
        let mut prototype = Self {
            trees,
            parts,
            lights: Vec::new(),
            center: Vec3::ZERO,
            half_width: 0.0,
        };
        if lights.len() <= MOST_OPENED {
            prototype.lights = lights.to_vec();
        }
        prototype.measure();
        Ok(prototype)
    }

    /// Refits the trees: see [`LightBvh::refit`].
    pub(crate) fn refit(&mut self, lights: &[LightExtent]) -> Result<(), LightBvhError> {
        let all = self.trees.scan_refit(lights)?;
        let is_whole = self.parts.len() == 1;
        for part in &mut self.parts {
            let power = if is_whole {
                all.power
            } else {
                let slots = &self.trees.slots;
                let own = alone(lights, |light| part.has(slots[light]));
                Scan::of(&own, DarkLights::Kept)?.power
            };
            part.refit(&mut self.trees, &Lights::new(lights, power), power);
        }
        if !self.lights.is_empty() {
            self.lights.copy_from_slice(lights);
        }
        self.measure();
        Ok(())
    }

    /// Measures the box of all lights.
    fn measure(&mut self) {
        let boxes = self.parts.iter().map(|part| part.moments.bounds);
        let bounds = boxes.fold(Aabb::EMPTY, Aabb::union);
        let (center, size) = if bounds.is_empty() {
            (Vec3::ZERO, Vec3::ZERO)
        } else {
            (bounds.center(), bounds.diagonal())
        };
        self.center = center;
        self.half_width = 0.5 * size.element_sum();
    }

    /// How many lights there are, with those that are off.
    #[must_use]
    pub fn len(&self) -> usize {
        self.trees.slots.len()
    }

    /// Whether there is no light.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.trees.slots.is_empty()
    }

    /// Levels of nodes of the deepest tree.
    #[must_use]
    pub fn depth(&self) -> usize {
        self.trees.depth()
    }

    /// Bytes that queries may touch.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.trees.bytes()
    }

    /// The parts, at least one.
    pub(crate) fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The part that a light is in, if it has a place.
    #[inline(always)]
    pub(crate) fn part_of(&self, light: LightId) -> Option<usize> {
        let slot = self.view().slot(light);
        self.parts.iter().position(|part| part.has(slot))
    }

    /// The trees of all parts; that of a part starts at its root.
    #[inline(always)]
    pub(crate) fn view(&self) -> LightBvhRef<'_> {
        self.trees.view()
    }
}

/// The lights of one part, without the others.
fn alone(lights: &[LightExtent], is_own: impl Fn(usize) -> bool) -> Vec<LightExtent> {
    let lights = lights.iter().enumerate();
    let own = lights.map(|(light, &extent)| if is_own(light) { extent } else { not_held() });
    own.collect()
}
