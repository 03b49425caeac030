use alloc::vec::Vec;

use light_bounds::{LightBounds, LightExtent};
use light_math::Aabb;
use light_math::glam::Vec3;

use crate::build::lights::{LeafMoments, phi};
use crate::build::options::{DarkLights, LightBvhOptions};
use crate::build::scan::{Scan, not_held};
use crate::build::topology::low_word;
use crate::importance::position::FAR;
use crate::instances::error::InstancedLightBvhError;
use crate::instances::leaf_ids::LeafIds;
use crate::instances::openings::Openings;
use crate::instances::placed_frame::PlacedFrame;
use crate::instances::placed_light::PlacedLight;
use crate::instances::placed_moments::{PlacedGroup, Turned, positive_float};
use crate::instances::placement::Placement;
use crate::instances::prototype::LightPrototype;
use crate::light_bvh::LightBvh;
use crate::node::moments::Moments;
use crate::node::wide_node::NOWHERE;
use crate::parallel::table;
use crate::simd::prefetch;

/// All placements, on their way into a tree.
pub(crate) struct Placed<'a> {
    pub(crate) prototypes: &'a [LightPrototype],
    pub(crate) placements: &'a [Placement],
    pub(crate) ids: LeafIds,
    pub(crate) frames: Vec<PlacedFrame>,
    /// Those of all leaves that are parts of placements; dark where a prototype has fewer parts.
    pub(crate) groups: Vec<PlacedGroup>,
}

impl<'a> Placed<'a> {
    /// The placements, whose prototypes are there.
    ///
    /// # Errors
    /// More parts than a tree can address; the first placement of a light beyond the reach of a
    /// tree.
    pub(crate) fn new(
        prototypes: &'a [LightPrototype],
        placements: &'a [Placement],
    ) -> Result<Self, InstancedLightBvhError> {
        let ids = LeafIds::new(prototypes);
        if !ids.fit(placements.len(), 0) {
            return Err(InstancedLightBvhError::TooManyPlacements);
        }
        let prototype = |p: &Placement| &prototypes[p.prototype as usize];
        let frames = table(placements.len(), |i| {
            PlacedFrame::new(&placements[i], prototype(&placements[i]))
        });
        let groups = table(ids.of(placements.len()), |leaf| {
            let (i, part) = ids.part(low_word(leaf));
            let (placement, frame) = (&placements[i as usize], &frames[i as usize]);
            let prototype = prototype(placement);
            let part = prototype.parts().get(part);
            part.map_or(PlacedGroup::DARK, |part| {
                PlacedGroup::new(prototype, part, frame, placement)
            })
        });
        for (leaf, group) in (0..).zip(&groups) {
            if group.power() > 0.0 && !is_within_reach(group.bounds()) {
                let (placement, _) = ids.part(leaf);
                return Err(InstancedLightBvhError::TooFar { placement });
            }
        }
        Ok(Self {
            prototypes,
            placements,
            ids,
            frames,
            groups,
        })
    }

    /// The upper tree over these placements, of which some are opened.
    ///
    /// # Errors
    /// None: groups that are near have valid extents.
    pub(crate) fn build(
        &self,
        options: &LightBvhOptions,
        openings: &Openings,
    ) -> Result<LightBvh, InstancedLightBvhError> {
        let extents = self.extents(openings);
        let scan = scan(&extents, options.dark)?;
        let leaves = self.leaves(openings, scan.power);
        Ok(LightBvh::build_of_leaves(&extents, &scan, options, &leaves).0)
    }

    /// Refits the upper tree `top` to these placements, of which the same are opened.
    ///
    /// # Errors
    /// The first placement of a light that was dark and has no place.
    pub(crate) fn refit(
        &self,
        top: &mut LightBvh,
        openings: &Openings,
    ) -> Result<(), InstancedLightBvhError> {
        let extents = self.extents(openings);
        for (leaf, (extent, &slot)) in extents.iter().zip(&top.slots).enumerate() {
            let is_lit = extent.bounded().is_some_and(|bounds| bounds.phi > 0.0);
            if is_lit && slot == NOWHERE {
                let placement = self.placement_of(leaf, openings);
                return Err(InstancedLightBvhError::NoPlace { placement });
            }
        }
        let power = scan(&extents, DarkLights::Kept)?.power;
        top.refit_to_leaves(power, &self.leaves(openings, power));
        Ok(())
    }

    /// The placement that a leaf is a part of, or a light.
    fn placement_of(&self, leaf: usize, openings: &Openings) -> u32 {
        match leaf.checked_sub(self.groups.len()) {
            Some(place) => openings.lights()[place].placement,
            None => self.ids.part(low_word(leaf)).0,
        }
    }

    /// What the builder reads of all leaves. Parts of opened placements have no place, and none
    /// have those that a prototype lacks.
    fn extents(&self, openings: &Openings) -> Vec<LightExtent> {
        let groups = self.groups.len();
        table(groups + openings.lights().len(), |leaf| {
            if let Some(place) = leaf.checked_sub(groups) {
                return self.extent_of_light(&openings.lights()[place]);
            }
            let (placement, part) = self.ids.part(low_word(leaf));
            let (prototype, ..) = self.placement(placement);
            if part < prototype.parts().len() && !openings.is_open(placement) {
                self.groups[leaf].extent()
            } else {
                not_held()
            }
        })
    }

    /// What the builder reads of one light: its centre, power, and cone.
    fn extent_of_light(&self, id: &PlacedLight) -> LightExtent {
        let (prototype, frame, placement) = self.placement(id.placement);
        let light = &prototype.lights[id.light.index()];
        let Some(bounds) = light.bounded() else {
            return *light;
        };
        let all = self.bounds(id.placement);
        let turned = Turned::new(prototype, frame, placement);
        let center = turned.place(bounds.bounds.center());
        let is_lit = all.min.x <= all.max.x;
        let center = if is_lit {
            center.clamp(all.min, all.max)
        } else {
            Vec3::ZERO
        };
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_point(center),
            w: turned.axis(bounds.w).normalize_or(Vec3::Z),
            phi: positive_float(f64::from(phi(light)) * f64::from(placement.power)),
            ..*bounds
        })
    }

    /// The box of all lights of a placement; empty if none is on.
    pub(crate) fn bounds(&self, placement: u32) -> Aabb {
        let first = self.ids.leaf(placement, 0).index();
        let parts = self.groups[first..].iter().take(self.ids.each());
        parts.fold(Aabb::EMPTY, |all, part| all.union(*part.bounds()))
    }

    /// The moments of one light, with a share of a power of which `inv_power` is one over.
    fn moments_of_light(&self, id: &PlacedLight, inv_power: f64) -> Moments {
        let (prototype, frame, placement) = self.placement(id.placement);
        let light = &prototype.lights[id.light.index()];
        let Some(part) = prototype.part_of(id.light) else {
            return Moments::NOTHING;
        };
        let group = &self.groups[self.ids.leaf(id.placement, part).index()];
        let part = &prototype.parts()[part];
        let light = group.of_light(prototype, part, frame, placement, light);
        light.moments(inv_power)
    }

    fn placement(&self, index: u32) -> (&LightPrototype, &PlacedFrame, &Placement) {
        let placement = &self.placements[index as usize];
        let prototype = &self.prototypes[placement.prototype as usize];
        (prototype, &self.frames[index as usize], placement)
    }

    /// All leaves, which together have the power `power`.
    fn leaves<'b>(&'b self, openings: &'b Openings, power: f64) -> PlacedLeaves<'b> {
        PlacedLeaves {
            placed: self,
            openings,
            inv_power: if power > 0.0 { 1.0 / power } else { 0.0 },
        }
    }
}

/// Whether a box is within the reach of a tree. Written so that NaN fails.
fn is_within_reach(bounds: &Aabb) -> bool {
    bounds.min.min_element() >= -FAR && bounds.max.max_element() <= FAR
}

fn scan(extents: &[LightExtent], dark: DarkLights) -> Result<Scan, InstancedLightBvhError> {
    Scan::of(extents, dark).map_err(|_| InstancedLightBvhError::TooManyPlacements)
}

/// The leaves of the upper tree.
struct PlacedLeaves<'a> {
    placed: &'a Placed<'a>,
    openings: &'a Openings,
    /// One over the power of all of them, 0 if they have none.
    inv_power: f64,
}

impl LeafMoments for PlacedLeaves<'_> {
    #[inline]
    fn moments(&self, leaf: u32) -> Moments {
        let Self {
            placed, openings, ..
        } = self;
        if let Some(group) = placed.groups.get(leaf as usize) {
            return group.moments(self.inv_power);
        }
        let place = leaf as usize - placed.groups.len();
        placed.moments_of_light(&openings.lights()[place], self.inv_power)
    }

    #[inline]
    fn prefetch(&self, leaf: u32) {
        prefetch::<1, _>(&self.placed.groups, leaf);
    }
}
