//! The rays of a cell: which light is tested from which place, by numbers that depend on the cell's
//! key alone.

use alloc::vec::Vec;
use core::borrow::Borrow;
use core::ops::Range;

use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_math::fraction;
use light_math::glam::Vec2;

use crate::cut::light_cut::{CutDetail, LightCut};
use crate::query::bvh_ref::LightBvhRef;
use crate::visibility::cell_factors::CellFactors;
use crate::visibility::cell_key::CellKey;
use crate::visibility::fill::ray_log::RayLog;
use crate::visibility::hash::mix;

/// Steps of a sequence that fills the unit square evenly, in every part of it: 1/p and 1/p^2, where
/// `p^3 = p + 1`, as fractions of 2^64.
///
/// # Source
/// `[Roberts2018]`, the sequence `R2`.
const STEPS: [u64; 2] = [0xc13f_a9a9_02a6_328f, 0x91e1_0da5_c79e_7b1d];

/// What rays are sent from and to. `visible` says whether a place sees a point of a light, `None` if
/// nothing is emitted toward it.
pub(super) struct Rays<'a, P, F> {
    pub(super) tree: LightBvhRef<'a>,
    pub(super) places: &'a [P],
    pub(super) key: CellKey,
    pub(super) visible: F,
    pub(super) log: RayLog,
}

/// The numbers of a ray.
struct Numbers {
    /// Which place.
    place: u32,
    /// Chooses the light.
    u: u64,
    /// Chooses its point.
    point: Vec2,
}

impl<P, F> Rays<'_, P, F>
where
    P: Borrow<LightSampleContext>,
    F: FnMut(&P, LightId, Vec2) -> Option<bool>,
{
    /// The rays of these numbers to lights that cuts of the tree choose: those of each place
    /// together, so that it makes one cut.
    pub(super) fn by_cuts(&mut self, stage: u64, range: Range<u32>) {
        let mut rays: Vec<(usize, u32)> = range
            .map(|ray| (self.numbers(stage, ray).place as usize, ray))
            .collect();
        rays.sort_unstable();
        for of_place in rays.chunk_by(|a, b| a.0 == b.0) {
            let Some(place) = of_place.first().and_then(|ray| self.places.get(ray.0)) else {
                continue;
            };
            let cut: LightCut<'_> = self.tree.cut(place.borrow(), CutDetail::default());
            for &(_, ray) in of_place {
                let numbers = self.numbers(stage, ray);
                self.send(place, cut.sample(numbers.u), &numbers);
            }
        }
    }

    /// `count` rays to lights that a cell chooses; `note` gets the place, the choice, and
    /// whether it was seen.
    pub(super) fn in_cell(
        &mut self,
        stage: u64,
        count: u32,
        cell: CellFactors<'_>,
        mut note: impl FnMut(&P, SampledLight, bool),
    ) {
        for ray in 0..count {
            let numbers = self.numbers(stage, ray);
            let Some(place) = self.places.get(numbers.place as usize) else {
                return;
            };
            let choice = self.tree.in_cell(cell).sample(place.borrow(), numbers.u);
            if let (Some(choice), Some(is_seen)) = (choice, self.send(place, choice, &numbers)) {
                note(place, choice, is_seen);
            }
        }
    }

    /// A ray to a chosen light, if there is one: whether it is seen.
    fn send(&mut self, place: &P, choice: Option<SampledLight>, numbers: &Numbers) -> Option<bool> {
        let light = choice?.light;
        let is_seen = (self.visible)(place, light, numbers.point);
        self.log.push(&self.tree, (numbers.place, light), is_seen);
        Some(is_seen == Some(true))
    }

    /// The numbers of one ray of a stage: places and lights evenly together, points at random.
    #[expect(clippy::cast_possible_truncation, reason = "indices of places")]
    fn numbers(&self, stage: u64, ray: u32) -> Numbers {
        let seed = mix(self.key.seed() ^ mix(stage));
        let [place, u] = [0, 1].map(|axis| {
            let start = mix(seed ^ axis as u64);
            start.wrapping_add(STEPS[axis].wrapping_mul(u64::from(ray)))
        });
        let random = mix(seed ^ mix(u64::from(ray) + 2));
        let (place, _) = fraction::choose(self.places.len() as u32, place);
        Numbers {
            place,
            u,
            point: Vec2::new(fraction::to_f32(random), fraction::to_f32(random << 32)),
        }
    }
}
