use light_bounds::{LightSampleContext, SampledLight};
use light_bvh::LightBvhOptions;
use light_math::glam::Vec3;
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, LightSampler, PowerLightSampler, PreparedChoices,
    ReferenceBvhLightSampler, UniformLightSampler,
};

use super::receivers::receiver;
use super::report::Row;
use light_sets::SetKind;

use crate::{Emitter, Rng, SamplerCase};

/// Choices for one receiver, one by one.
const SINGLE: u32 = 8;

/// Choices for one receiver at once.
const SEVERAL: [u32; 3] = [2, 4, 8];

/// `None` results that are allowed for each choice that is compared.
const MOST_NONE: u64 = 8;

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
    let mut prepared = PreparedChoices::default();
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
            query.single(rng.f64());
        }
        query.emitter(rng.f64());
        let k = SEVERAL[rng.below(SEVERAL.len())];
        query.several(rng.f64(), k, &mut prepared);
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
    fn single(&mut self, u: f64) {
        let chosen = self.sampler.sample(self.ctx, u);
        let pmf = |chosen: &SampledLight| self.sampler.pmf(self.ctx, chosen.light);
        let pmf = chosen.as_ref().map(pmf);
        self.note(chosen, pmf, "", u);
    }

    fn emitter(&mut self, u: f64) {
        let chosen = self.sampler.sample_emitter(u);
        let pmf = |chosen: &SampledLight| self.sampler.pmf_emitter(chosen.light);
        let pmf = chosen.as_ref().map(pmf);
        self.note(chosen, pmf, "emitter, ", u);
    }

    /// Checks all choices by the prepared ones, and the last also by a query without them.
    fn several(&mut self, u: f64, k: u32, prepared: &mut PreparedChoices) {
        let mut all = Vec::with_capacity(k as usize);
        let sampler = self.sampler;
        sampler.sample_many_prepared(self.ctx, u, k, prepared, &mut |light| all.push(light));
        for &chosen in &all {
            let pmf = sampler.pmf_many_prepared(self.ctx, chosen.light, k, prepared);
            self.note(Some(chosen), Some(pmf), "of several, prepared, ", u);
        }
        if let Some(&last) = all.last() {
            let pmf = sampler.pmf_many(self.ctx, last.light, k);
            self.note(Some(last), Some(pmf), "of several, ", u);
        }
        self.row.none += u64::from(k) - all.len() as u64;
    }

    fn note(&mut self, chosen: Option<SampledLight>, pmf: Option<f32>, how: &str, u: f64) {
        let (Some(chosen), Some(pmf)) = (chosen, pmf) else {
            self.row.none += 1;
            return;
        };
        let holds = chosen.pmf.to_bits() == pmf.to_bits()
            && chosen.pmf > 0.0
            && chosen.pmf <= 1.0
            && (0.0..1.0).contains(&chosen.u)
            && chosen.light.0 < self.known;
        let fault = || {
            let (name, ctx) = (self.name, self.ctx);
            format!("{name}, {how}u = {u}: {chosen:?}, queried pmf {pmf}, at {ctx:?}")
        };
        let fault = (!holds).then(fault);
        self.row.count(fault);
    }
}
