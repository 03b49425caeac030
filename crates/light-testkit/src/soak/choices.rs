use light_bounds::{LightSampleContext, SampledLight};
use light_bvh::LightBvhOptions;
use light_math::fraction;
use light_math::glam::Vec3;
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, LightSampler, PowerLightSampler,
    ReferenceBvhLightSampler, UniformLightSampler,
};

use super::receivers::receiver;
use super::report::Row;
use light_sets::SetKind;

use crate::{Emitter, Rng, SamplerCase};

/// Choices for one receiver, one by one.
const SINGLE: u32 = 8;

/// Choices for one receiver together.
const SEVERAL: [u32; 3] = [2, 4, 8];

/// `None` results that are allowed for each choice that is compared.
const MOST_NONE: u64 = 8;

/// The least probability of which the place in its interval of `u` is tested, and how far that may
/// be off: probabilities are rounded at each level.
const LEAST_PMF: f64 = 1e-9;
const PLACE_ERROR: f64 = 1e-4;

/// Above so many lights a sampler that looks at all of them is left out.
const FEW: usize = 64;

/// A set of lights and every sampler of it.
pub(super) struct SoakSet {
    set: SamplerCase,
    samplers: Vec<(&'static str, Box<dyn LightSampler + Sync + Send>)>,
}

/// Generated sets of several sizes, the same below a sky and two suns, and the adversarial ones.
pub(super) fn sets() -> Vec<SoakSet> {
    let mut sets = Vec::new();
    for n in [40, 1000, 30_000] {
        let generated = [
            SamplerCase::generated(SetKind::Uniform, n, 51),
            SamplerCase::generated(SetKind::Clusters, n, 52),
            SamplerCase::generated(SetKind::Spots, n, 53),
            SamplerCase::mixed(n, 54),
        ];
        for set in generated {
            sets.push(below_a_sky(&set));
            sets.push(set);
        }
    }
    let adversarial = SamplerCase::adversarial(60);
    sets.extend(
        adversarial
            .into_iter()
            .filter(|set| !set.emitters.is_empty()),
    );
    sets.into_iter().map(SoakSet::new).collect()
}

/// One empty row a set.
pub(super) fn rows(sets: &[SoakSet]) -> Vec<Row> {
    let name = |set: &SoakSet| format!("{}, {} lights", set.set.name, set.set.emitters.len());
    sets.iter().map(|set| Row::new(name(set))).collect()
}

fn below_a_sky(set: &SamplerCase) -> SamplerCase {
    let mut set = set.clone();
    let sun = |wi: Vec3, irradiance| Emitter::Sun { wi, irradiance };
    set.emitters.push(Emitter::Sky { radiance: 0.1 });
    set.emitters.push(sun(Vec3::new(0.6, 0.0, 0.8), 2.0));
    set.emitters.push(sun(Vec3::new(0.0, 0.8, -0.6), 1e-3));
    SamplerCase {
        name: match set.name {
            "uniform" => "uniform below a sky",
            "clusters" => "clusters below a sky",
            "spots" => "spots below a sky",
            _ => "mixed below a sky",
        },
        ..set
    }
}

impl SoakSet {
    fn new(set: SamplerCase) -> Self {
        let extents = set.extents();
        let valid = "generated lights are valid";
        let tree = BvhLightSampler::new(&extents).expect(valid);
        let fast = BvhLightSampler::with(&extents, &LightBvhOptions::FAST).expect(valid);
        let reference = ReferenceBvhLightSampler::new(&extents).expect(valid);
        let power = PowerLightSampler::new(&set.powers()).expect(valid);
        let mut samplers: Vec<(&'static str, Box<dyn LightSampler + Sync + Send>)> = vec![
            ("default", Box::new(tree)),
            ("fast", Box::new(fast)),
            ("reference", Box::new(reference)),
            ("power", Box::new(power)),
            ("uniform", Box::new(UniformLightSampler::new(set.count()))),
        ];
        if extents.len() <= FEW {
            let exhaustive = ExhaustiveLightSampler::new(&extents).expect(valid);
            samplers.push(("exhaustive", Box::new(exhaustive)));
        }
        Self { set, samplers }
    }
}

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
        turn += 1;
        let other = turn / 2 % set.samplers.len();
        let (name, sampler) = &set.samplers[if turn % 2 == 0 { 0 } else { other }];
        let mut query = SoakQuery {
            name,
            sampler: &**sampler,
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
    }
    row
}

/// A sampler, the context it is queried at, and the row that records the results.
struct SoakQuery<'a> {
    name: &'a str,
    sampler: &'a dyn LightSampler,
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
        self.note(chosen, pmf, "emitter, ", u);
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

    fn note(&mut self, chosen: Option<SampledLight>, pmf: Option<f32>, how: &str, u: u64) {
        let (Some(chosen), Some(pmf)) = (chosen, pmf) else {
            self.row.none += 1;
            return;
        };
        let holds = chosen.pmf.to_bits() == pmf.to_bits()
            && chosen.pmf > 0.0
            && chosen.pmf <= 1.0
            && chosen.light.0 < self.known;
        let fault = || {
            let (name, ctx) = (self.name, self.ctx);
            format!("{name}, {how}u = {u}: {chosen:?}, queried pmf {pmf}, at {ctx:?}")
        };
        let fault = (!holds).then(fault);
        self.row.count(fault);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_bounds::LightId;
    use light_samplers::LightChoices;

    /// A uniform choice of four lights that leaves the same `u`, or states another pmf.
    #[derive(Clone, Copy, PartialEq)]
    enum Broken {
        Right,
        SameU,
        OtherPmf,
    }

    impl LightSampler for Broken {
        fn sample(&self, _: &LightSampleContext, u: u64) -> Option<SampledLight> {
            self.sample_emitter(u)
        }

        fn pmf(&self, _: &LightSampleContext, light: LightId) -> f32 {
            self.pmf_emitter(light)
        }

        fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
            LightChoices::one_by_one(self, ctx, count)
        }

        fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
            let (light, rest) = fraction::choose(4, u);
            Some(SampledLight {
                light: LightId(light),
                pmf: 0.25,
                u: if *self == Self::SameU { u } else { rest },
            })
        }

        fn pmf_emitter(&self, _: LightId) -> f32 {
            if *self == Self::OtherPmf { 0.2 } else { 0.25 }
        }
    }

    #[test]
    fn faults_are_counted() {
        let ctx = LightSampleContext::medium(Vec3::ZERO);
        let mismatches = |sampler: Broken| {
            let mut row = Row::default();
            let mut query = SoakQuery {
                name: "broken",
                sampler: &sampler,
                known: 4,
                ctx: &ctx,
                row: &mut row,
            };
            query.single(1 << 60);
            query.emitter(1 << 60);
            query.middle(1 << 60);
            query.several(1 << 60, 2);
            (row.samples, row.mismatches)
        };
        assert_eq!(mismatches(Broken::Right), (6, 0), "none");
        assert_eq!(mismatches(Broken::SameU), (6, 1), "the middle");
        assert_eq!(mismatches(Broken::OtherPmf), (6, 5), "all but the middle");
    }
}
