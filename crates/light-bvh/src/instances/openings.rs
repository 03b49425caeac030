use alloc::vec;
use alloc::vec::Vec;

use light_bounds::{LightId, SampledLight};

use crate::instances::placed_light::{PlacedLight, SampledPlacedLight};
use crate::instances::placement::Placement;
use crate::instances::prototype::LightPrototype;
use crate::node::wide_node::NOWHERE;

/// The opened placements: their lights are leaves of the upper tree, after the parts of all
/// placements.
#[derive(Clone, Debug)]
pub(crate) struct Openings {
    /// The leaf of the first light of each placement, [`NOWHERE`] if it is not opened; empty if
    /// none is.
    first: Vec<u32>,
    /// How many leaves are parts of placements.
    parts: u32,
    /// The lights that the leaves after them are.
    lights: Vec<PlacedLight>,
}

impl Openings {
    /// No placement is opened.
    pub(crate) const NONE: Self = Self {
        first: Vec::new(),
        parts: 0,
        lights: Vec::new(),
    };

    /// All lights of the `opened` ones among `placements`, after so many parts. Leaves have 32 bits.
    #[expect(clippy::cast_possible_truncation, reason = "at most 2^28 leaves")]
    pub(crate) fn new(
        prototypes: &[LightPrototype],
        placements: &[Placement],
        parts: usize,
        opened: &[u32],
    ) -> Self {
        if opened.is_empty() {
            return Self::NONE;
        }
        let mut first = vec![NOWHERE; placements.len()];
        let mut lights = Vec::new();
        for &placement in opened {
            first[placement as usize] = (parts + lights.len()) as u32;
            let prototype = &prototypes[placements[placement as usize].prototype as usize];
            let ids = (0..prototype.len() as u32).map(LightId);
            lights.extend(ids.map(|light| PlacedLight { placement, light }));
        }
        Self {
            first,
            parts: parts as u32,
            lights,
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    /// The lights of opened placements, in the order of their leaves.
    pub(crate) fn lights(&self) -> &[PlacedLight] {
        &self.lights
    }

    /// Whether the placement is opened.
    pub(crate) fn is_open(&self, placement: u32) -> bool {
        self.first
            .get(placement as usize)
            .is_some_and(|&leaf| leaf != NOWHERE)
    }

    /// The leaf of a light of an opened placement.
    #[inline(always)]
    pub(crate) fn leaf(&self, light: PlacedLight) -> Option<LightId> {
        let first = *self.first.get(light.placement as usize)?;
        let leaf = first.checked_add(light.light.0)?;
        let place = leaf.checked_sub(self.parts)?;
        (self.lights.get(place as usize) == Some(&light)).then_some(LightId(leaf))
    }

    /// The chosen light, unless a part was chosen.
    #[inline(always)]
    pub(crate) fn light(&self, chosen: &SampledLight) -> Option<SampledPlacedLight> {
        let place = chosen.light.0.checked_sub(self.parts)?;
        let light = *self.lights.get(place as usize)?;
        let SampledLight { pmf, u, .. } = *chosen;
        Some(SampledPlacedLight { light, pmf, u })
    }

    /// Frees the lights of prototypes that no opened placement is of.
    pub(crate) fn forget_unopened(
        &self,
        prototypes: &mut [LightPrototype],
        placements: &[Placement],
    ) {
        let mut is_needed = vec![false; prototypes.len()];
        for (index, placement) in (0..).zip(placements) {
            is_needed[placement.prototype as usize] |= self.is_open(index);
        }
        for (prototype, is_needed) in prototypes.iter_mut().zip(is_needed) {
            if !is_needed {
                prototype.lights = Vec::new();
            }
        }
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.first) + size_of_val(&*self.lights)
    }
}
