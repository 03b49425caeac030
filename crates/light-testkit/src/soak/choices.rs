use light_bounds::{
    LightGroups, LightId, LightSampleContext, ReceiverKind, ReceiverSides, SampledLight,
};
use light_math::fraction;
use light_samplers::LightSampler;

use super::receivers::receiver;
use super::report::Row;
use super::sets::SoakSet;
use crate::Rng;

/// Choices for one receiver, one by one.
const SINGLE: u32 = 8;

/// Choices for one receiver together.
const SEVERAL: [u32; 3] = [2, 4, 8];

/// `None` results that are allowed for each choice that is compared.
const MOST_NONE: u64 = 8;

/// How a choice without a receiver is named.
const EMITTER: &str = "emitter, ";

/// How far a sum of pmfs may be above one by rounding.
const ROUNDING: f64 = 2e-5;

/// The pmfs of at most so many lights are summed.
const FEW: usize = 64;

/// The groups that contexts ask for.
const WANTED: [LightGroups; 5] = [
    LightGroups::of(0),
    LightGroups::of(1),
    LightGroups::of(30),
    LightGroups(LightGroups::of(0).0 | LightGroups::of(1).0),
    LightGroups::ALL,
];

/// The least probability of which the place in its interval of `u` is tested, and how far that may
/// be off: probabilities are rounded at each level.
const LEAST_PMF: f64 = 1e-9;
const PLACE_ERROR: f64 = 1e-4;

/// Takes `count` choices, half of them by the default sampler, the others by each of the rest in
/// turn.
pub(super) fn soak(set: &SoakSet, count: u64, seed: u64) -> Row {
    let mut rng = Rng::new(seed);
    let mut row = Row::default();
    let (low, high) = set.set.corners();
    let mut turn = 0;
    // Where few lights can be chosen, nearly all results are `None`.
    while row.samples < count && row.none < MOST_NONE * count {
        let ctx = if rng.below(8) == 0 && !set.set.contexts.is_empty() {
            set.set.contexts[rng.below(set.set.contexts.len())]
        } else {
            receiver(&mut rng, low, high)
        };
        let ctx = match set.groups.is_empty() {
            true => ctx,
            false => ctx.with_groups(WANTED[rng.below(WANTED.len())]),
        };
        turn += 1;
        let other = turn / 2 % set.samplers.len();
        let (name, sampler) = &set.samplers[if turn % 2 == 0 { 0 } else { other }];
        let mut query = SoakQuery {
            name,
            sampler: &**sampler,
            set: Some(set),
            known: set.set.count(),
            ctx: &ctx,
            row: &mut row,
        };
        for _ in 0..SINGLE {
            query.single(rng.u64());
        }
        if *name != "power" {
            query.middle(rng.u64());
        }
        query.emitter(rng.u64());
        let k = SEVERAL[rng.below(SEVERAL.len())];
        query.several(rng.u64(), k);
        query.contribution(LightId(rng.below(set.set.emitters.len()) as u32));
        if set.set.emitters.len() <= FEW {
            query.sum();
        }
    }
    row
}

/// Whether the contribution of a light to the receiver is known: that of segments is another, and
/// what a surface transmits or mirrors is left out of it.
fn has_contribution(ctx: &LightSampleContext) -> bool {
    match ctx.kind() {
        ReceiverKind::Surface { sides, .. } => *sides == ReceiverSides::Front,
        ReceiverKind::Medium => true,
        _ => false,
    }
}

/// A sampler, the context it is queried at, and the row that records the results.
struct SoakQuery<'a> {
    name: &'a str,
    sampler: &'a dyn LightSampler,
    /// `None` where only choices are looked at.
    set: Option<&'a SoakSet>,
    known: u32,
    ctx: &'a LightSampleContext,
    row: &'a mut Row,
}

impl SoakQuery<'_> {
    fn single(&mut self, u: u64) {
        let chosen = self.sampler.sample(self.ctx, u);
        let pmf = |chosen: &SampledLight| self.sampler.pmf(self.ctx, chosen.light);
        let pmf = chosen.as_ref().map(pmf);
        self.note(chosen, pmf, "", u);
    }

    /// What is left of `u` says where the interval of its light begins: the middle of that leads to
    /// the same light, and leaves a half. An alias table has no such intervals.
    fn middle(&mut self, u: u64) {
        let Some(chosen) = self.sampler.sample(self.ctx, u) else {
            return;
        };
        let pmf = f64::from(chosen.pmf);
        if pmf < LEAST_PMF {
            return;
        }
        let start = fraction::to_f64(u) - pmf * fraction::to_f64(chosen.u);
        let middle = fraction::from_f64(start + 0.5 * pmf);
        let again = self.sampler.sample(self.ctx, middle);
        let is_half = |u| (fraction::to_f64(u) - 0.5).abs() <= PLACE_ERROR;
        let holds = again.is_some_and(|again| again.light == chosen.light && is_half(again.u));
        let fault = || {
            let (name, ctx) = (self.name, self.ctx);
            format!("{name}, u = {u}: {chosen:?}, in the middle, {middle}: {again:?}, at {ctx:?}")
        };
        let fault = (!holds).then(fault);
        self.row.count(fault);
    }

    fn emitter(&mut self, u: u64) {
        let chosen = self.sampler.sample_emitter(u);
        let pmf = |chosen: &SampledLight| self.sampler.pmf_emitter(chosen.light);
        let pmf = chosen.as_ref().map(pmf);
        self.note(chosen, pmf, EMITTER, u);
    }

    /// A light that contributes at a surface or in a medium, and is asked for, has a pmf above 0;
    /// one that is not asked for has none.
    fn contribution(&mut self, light: LightId) {
        let Some(set) = self.set else { return };
        let (pmf, ctx) = (self.sampler.pmf(self.ctx, light), self.ctx);
        let holds = if !set.is_wanted(light, ctx) {
            pmf == 0.0
        } else if has_contribution(ctx) {
            pmf > 0.0 || set.set.emitters[light.index()].contribution(ctx) == 0.0
        } else {
            pmf >= 0.0
        };
        if !holds {
            let fault = format!("{}: {light:?} has pmf {pmf} at {ctx:?}", self.name);
            self.row.count(Some(fault));
        }
    }

    /// The pmfs of all lights sum to one at most.
    fn sum(&mut self) {
        let pmf = |id| f64::from(self.sampler.pmf(self.ctx, LightId(id)));
        let sum: f64 = (0..self.known).map(pmf).sum();
        if !(sum <= 1.0 + ROUNDING) {
            let fault = format!("{}: pmfs sum to {sum} at {:?}", self.name, self.ctx);
            self.row.count(Some(fault));
        }
    }

    /// Checks all choices by what is known at the context, and the last also by what is computed
    /// there again.
    fn several(&mut self, u: u64, k: u32) {
        let sampler = self.sampler;
        let here = sampler.at(self.ctx, k);
        let (mut last, mut count) = (None, 0);
        for chosen in here.samples(u) {
            self.note(
                Some(chosen),
                Some(here.pmf(chosen.light)),
                "of several, ",
                u,
            );
            (last, count) = (Some(chosen), count + 1);
        }
        if let Some(last) = last {
            let pmf = sampler.at(self.ctx, k).pmf(last.light);
            self.note(Some(last), Some(pmf), "of several, again, ", u);
        }
        self.row.none += u64::from(k) - count;
    }

    fn is_wanted(&self, light: LightId) -> bool {
        self.set.is_none_or(|set| set.is_wanted(light, self.ctx))
    }

    fn note(&mut self, chosen: Option<SampledLight>, pmf: Option<f32>, how: &str, u: u64) {
        let (Some(chosen), Some(pmf)) = (chosen, pmf) else {
            self.row.none += 1;
            return;
        };
        let holds = chosen.pmf.to_bits() == pmf.to_bits()
            && chosen.pmf > 0.0
            && chosen.pmf <= 1.0
            && chosen.light.0 < self.known
            && (how == EMITTER || self.is_wanted(chosen.light));
        let fault = || {
            let (name, ctx) = (self.name, self.ctx);
            format!("{name}, {how}u = {u}: {chosen:?}, queried pmf {pmf}, at {ctx:?}")
        };
        let fault = (!holds).then(fault);
        self.row.count(fault);
    }
}

#[cfg(test)]
mod tests;
