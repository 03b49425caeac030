use alloc::vec::Vec;
use core::iter;

use light_bounds::{LightExtent, LightGroups, LightId};

use crate::build::options::LightBvhOptions;
use crate::instances::error::InstancedLightBvhError;
use crate::instances::frames::Frames;
use crate::instances::leaf_ids::LeafIds;
use crate::instances::light_ranges::LightRanges;
use crate::instances::openings::Openings;
use crate::instances::overlaps::placements_to_open;
use crate::instances::placed::Placed;
use crate::instances::placed_frame::PlacedFrame;
use crate::instances::placed_light::PlacedLight;
use crate::instances::placement::Placement;
use crate::instances::prototype::{LightPrototype, MOST_OPENED};
use crate::light_bvh::LightBvh;

/// A tree of trees: lights that are placed many times are stored once.
///
/// Prototypes are placed with a rotation, one scale and a translation. The leaves of the upper tree
/// are the [parts](LightPrototype) of placements. A node of it knows the moments of these groups as
/// a node of [`LightBvh`] knows those of lights, and a choice goes on from a leaf to the root of a
/// part, with the receiver in the frame of the prototype. 24 to 29 bytes a light of a prototype,
/// about 72 a placement, and 57 for each further part of one.
///
/// Placements that reach into others are opened when the tree is built: their lights are leaves of
/// the upper tree, as if they were copied, about 40 bytes each. At most 2^20 lights are, of those
/// placements first that reach into most parts of others.
///
/// The laws are those of [`LightBvh`]: a sampled pmf has the bits of the queried one, a light that
/// can contribute has a pmf above 0, and the pmfs and the probability of `None` add up to 1.
///
/// ```
/// use light_bvh::{InstancedLightBvh, LightPrototype, Placement};
/// # use light_bvh::light_bounds::light_math::{Aabb, glam::{Quat, Vec3}};
/// # use light_bvh::light_bounds::{LightBounds, LightExtent, LightSampleContext};
/// # let point = |x: f32| {
/// #     LightExtent::Bounded(LightBounds {
/// #         bounds: Aabb::from_point(Vec3::new(x, 0.0, 3.0)),
/// #         w: Vec3::Z,
/// #         phi: 60.0,
/// #         cos_theta_o: -1.0,
/// #         cos_theta_e: 0.0,
/// #         two_sided: false,
/// #     })
/// # };
/// # let windows: Vec<LightExtent> = (0..100u8).map(|i| point(f32::from(i))).collect();
/// let house = LightPrototype::new(&windows)?;
/// let mut placements = Vec::new();
/// for i in 0..1000u16 {
///     let turn = Quat::from_rotation_z(f32::from(i));
///     let at = Vec3::new(f32::from(i % 40) * 200.0, f32::from(i / 40) * 200.0, 0.0);
///     placements.push(Placement::new(0, turn, 1.0, at)?);
/// }
/// let tree = InstancedLightBvh::build(vec![house], &placements)?;
/// assert_eq!(tree.light_count(), 100_000);
///
/// let street = LightSampleContext::surface(Vec3::splat(1.0), Vec3::Z, Vec3::Z);
/// let choice = tree.sample(&street, 1 << 63).ok_or("no light")?;
/// assert_eq!(choice.pmf, tree.pmf(&street, choice.light)); // to the bit
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct InstancedLightBvh {
    top: LightBvh,
    ids: LeafIds,
    frames: Frames,
    openings: Openings,
    prototypes: Vec<LightPrototype>,
    ranges: LightRanges,
}

impl InstancedLightBvh {
    /// The tree of `prototypes` where `placements` place them.
    ///
    /// # Errors
    /// More than 2^28 parts of placements; the first placement of a prototype that is not among the
    /// first 2^30, or with a light beyond ±1e36.
    pub fn build(
        prototypes: Vec<LightPrototype>,
        placements: &[Placement],
    ) -> Result<Self, InstancedLightBvhError> {
        Self::build_with(prototypes, placements, &LightBvhOptions::default())
    }

    /// The same, with an upper tree built as `options` say;
    /// [`DarkLights::Kept`](crate::DarkLights::Kept) gives a place to dark placements.
    ///
    /// # Errors
    /// As for [`build`](Self::build).
    pub fn build_with(
        prototypes: Vec<LightPrototype>,
        placements: &[Placement],
        options: &LightBvhOptions,
    ) -> Result<Self, InstancedLightBvhError> {
        Self::build_opening(prototypes, placements, options, MOST_OPENED)
    }

    /// The same, and with at most `most_opened` lights of opened placements instead of 2^20: with 0
    /// the build and refits take the least time and memory. Prototypes of more than 2^20 lights are
    /// not opened.
    ///
    /// # Errors
    /// As for [`build`](Self::build).
    pub fn build_opening(
        prototypes: Vec<LightPrototype>,
        placements: &[Placement],
        options: &LightBvhOptions,
        most_opened: usize,
    ) -> Result<Self, InstancedLightBvhError> {
        for (placement, placed) in (0..).zip(placements) {
            if placed.prototype as usize >= prototypes.len().min(PlacedFrame::PROTOTYPES) {
                return Err(InstancedLightBvhError::Prototype { placement });
            }
        }
        let placed = Placed::new(&prototypes, placements)?;
        let closed = placed.build(options, &Openings::NONE)?;
        let opened = placements_to_open(&closed, &placed, most_opened);
        let openings = Openings::new(&prototypes, placements, placed.groups.len(), &opened);
        let top = if openings.is_empty() {
            closed
        } else {
            placed.build(options, &openings)?
        };
        let ids = placed.ids;
        let frames = Frames::new(placed.frames, placements, &top, ids, &openings);
        let count = |placement: &Placement| prototypes[placement.prototype as usize].len();
        let ranges = LightRanges::new(placements.iter().map(count));
        let mut prototypes = prototypes;
        openings.forget_unopened(&mut prototypes, placements);
        Ok(Self {
            top,
            ids,
            frames,
            openings,
            ranges,
            prototypes,
        })
    }

    /// Refits the upper tree to placements that moved, in time linear in the placements: the
    /// prototypes stay, and so do all ids. See [`LightBvh::refit`].
    ///
    /// # Errors
    /// Another number of placements, or another prototype of one; a light beyond ±1e36; a placement
    /// that was dark and has no place. The tree does not change then.
    pub fn refit(&mut self, placements: &[Placement]) -> Result<(), InstancedLightBvhError> {
        let prototypes = self.frames.prototypes();
        if placements.len() != prototypes.len() {
            let expected = prototypes.len();
            return Err(InstancedLightBvhError::OtherPlacements { expected });
        }
        for ((placement, placed), &prototype) in (0..).zip(placements).zip(prototypes) {
            if placed.prototype != prototype {
                return Err(InstancedLightBvhError::Prototype { placement });
            }
        }
        let placed = Placed::new(&self.prototypes, placements)?;
        placed.refit(&mut self.top, &self.openings)?;
        self.frames = Frames::new(
            placed.frames,
            placements,
            &self.top,
            self.ids,
            &self.openings,
        );
        Ok(())
    }

    /// Refits a prototype to lights that moved or changed their power, wherever it is placed, and
    /// then the upper tree, for `placements` as for [`refit`](Self::refit).
    ///
    /// # Errors
    /// Those of [`LightBvh::refit`] as [`InstancedLightBvhError::Lights`], and of
    /// [`refit`](Self::refit): after one of these the prototype is refitted, and the upper tree is
    /// as it was.
    ///
    /// # Panics
    /// If there is no prototype of that index.
    pub fn refit_prototype(
        &mut self,
        prototype: usize,
        lights: &[LightExtent],
        placements: &[Placement],
    ) -> Result<(), InstancedLightBvhError> {
        self.prototypes[prototype]
            .refit(lights)
            .map_err(InstancedLightBvhError::Lights)?;
        self.refit(placements)
    }

    /// Sets the groups of all lights of each placement: a context that asks for some groups then
    /// chooses among the placements of these. They stay through refits.
    ///
    /// # Errors
    /// [`InstancedLightBvhError::OtherPlacements`] if these are not as many as the placements.
    pub fn set_groups(&mut self, groups: &[LightGroups]) -> Result<(), InstancedLightBvhError> {
        let expected = self.frames.prototypes().len();
        let refused = InstancedLightBvhError::OtherPlacements { expected };
        if groups.len() != expected {
            return Err(refused);
        }
        let of_lights = self.openings.lights().iter();
        let of_lights = of_lights.map(|light| groups[light.placement as usize]);
        let of_parts = groups.iter();
        let of_parts = of_parts.flat_map(|&groups| iter::repeat_n(groups, self.ids.each()));
        let groups: Vec<_> = of_parts.chain(of_lights).collect();
        self.top.set_groups(&groups).map_err(|_| refused)
    }

    /// How many lights there are, those of each placement counted.
    #[must_use]
    pub fn light_count(&self) -> u64 {
        self.ranges.count()
    }

    /// The number of a light among all: those of the first placement come first, in the order of
    /// the prototype, then those of the second. `None` if there is no such light.
    #[inline]
    #[must_use]
    pub fn light_index(&self, light: PlacedLight) -> Option<u64> {
        self.ranges.index(light)
    }

    /// The light of a number, as [`light_index`](Self::light_index) counts; a binary search among
    /// the placements.
    #[inline]
    #[must_use]
    pub fn light_of_index(&self, index: u64) -> Option<PlacedLight> {
        self.ranges.light(index)
    }

    /// The upper tree, whose lights are parts of placements, those of a placement one after the
    /// other, and after all of them the lights of opened placements.
    #[must_use]
    pub const fn top(&self) -> &LightBvh {
        &self.top
    }

    /// The prototypes.
    #[must_use]
    pub fn prototypes(&self) -> &[LightPrototype] {
        &self.prototypes
    }

    /// The power of all placed lights; the largest float where it is above that.
    #[must_use]
    pub const fn power(&self) -> f32 {
        self.top.power()
    }

    /// Bytes that queries may touch.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let prototypes = self.prototypes.iter();
        let prototypes: usize = prototypes.map(LightPrototype::bytes).sum();
        let placements = self.frames.bytes() + self.ranges.bytes();
        let placements = placements + self.openings.bytes();
        self.top.bytes() + placements + prototypes
    }

    pub(crate) const fn openings(&self) -> &Openings {
        &self.openings
    }

    pub(crate) const fn ids(&self) -> LeafIds {
        self.ids
    }

    /// The leaf that a light is in, and the frame and the prototype of its placement; `None` if it
    /// has no place.
    #[inline(always)]
    pub(crate) fn leaf(
        &self,
        light: PlacedLight,
    ) -> Option<(LightId, &PlacedFrame, &LightPrototype)> {
        let prototype = self.prototype(light.placement)?;
        let part = prototype.part_of(light.light)?;
        let leaf = self.ids.leaf(light.placement, part);
        let frame = self.frames.of(leaf, &self.top.view(), self.ids)?;
        Some((leaf, frame, prototype))
    }

    /// The prototype of a placement.
    #[inline(always)]
    pub(crate) fn prototype(&self, placement: u32) -> Option<&LightPrototype> {
        let prototype = *self.frames.prototypes().get(placement as usize)?;
        self.prototypes.get(prototype as usize)
    }

    pub(crate) const fn frames(&self) -> &Frames {
        &self.frames
    }
}
