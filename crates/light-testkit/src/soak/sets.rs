use light_bounds::{LightGroups, LightId, LightSampleContext};
use light_bvh::LightBvhOptions;
use light_math::glam::Vec3;
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, GroupedLightSampler, LightSampler, PowerLightSampler,
    ReferenceBvhLightSampler, UniformLightSampler,
};
use light_sets::SetKind;

use super::report::Row;
use crate::{Emitter, PlacedCase, SamplerCase, stored};

/// Above so many lights a sampler that looks at all of them is left out.
const FEW: usize = 64;

/// A set of lights and every sampler of it.
pub(super) struct SoakSet {
    pub(super) set: SamplerCase,
    /// Of all lights by id; empty where no context asks for groups.
    pub(super) groups: Vec<LightGroups>,
    pub(super) samplers: Vec<(&'static str, AnySampler)>,
}

type AnySampler = Box<dyn LightSampler + Sync + Send>;

/// Generated sets of several sizes, the same below a sky and two suns, the last of them also in
/// groups, the adversarial ones, and prototypes that are placed many times.
pub(super) fn sets() -> Vec<SoakSet> {
    let (mut sets, mut grouped) = (Vec::new(), Vec::new());
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
        grouped.push(SamplerCase {
            name: "mixed below a sky, in groups",
            ..below_a_sky(&SamplerCase::mixed(n, 55))
        });
    }
    let adversarial = SamplerCase::adversarial(60);
    sets.extend(
        adversarial
            .into_iter()
            .filter(|set| !set.emitters.is_empty()),
    );
    let sets = sets.into_iter().map(|set| SoakSet::new(set, Vec::new()));
    let grouped = grouped.into_iter().map(|set| {
        let groups = groups(set.emitters.len());
        SoakSet::new(set, groups)
    });
    let placed = [20, 400].map(|count| SoakSet::placed(&PlacedCase::village(count, 56)));
    sets.chain(grouped).chain(placed).collect()
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

/// Groups of so many lights: one in three is in group 0, one in 31 in group 1, one in seven in all
/// of them; a third of the rest is in group 30 too, and most are in none.
fn groups(count: usize) -> Vec<LightGroups> {
    let of = |i: usize| {
        let is_in = |every: usize, groups| match i % every {
            0 => groups,
            _ => LightGroups::NONE,
        };
        let [a, b, c] = [0, 1, 30].map(LightGroups::of);
        is_in(3, a) | is_in(31, b) | is_in(7, LightGroups::ALL) | is_in(9, c)
    };
    (0..count).map(of).collect()
}

impl SoakSet {
    pub(super) fn new(set: SamplerCase, groups: Vec<LightGroups>) -> Self {
        let extents = set.extents();
        let valid = "generated lights are valid";
        let tree = |options: &LightBvhOptions| {
            let mut tree = BvhLightSampler::with_options(&extents, options).expect(valid);
            set_groups(&mut tree, &groups);
            tree
        };
        let mut refitted =
            BvhLightSampler::with_options(&set.exchanged_extents(), &LightBvhOptions::DYNAMIC)
                .expect(valid);
        set_groups(&mut refitted, &groups);
        refitted.refit(&extents).expect("as many lights");
        let default = tree(&LightBvhOptions::default());
        let mut samplers: Vec<(&'static str, AnySampler)> = vec![
            ("stored", Box::new(stored(&default))),
            ("fast", Box::new(tree(&LightBvhOptions::FAST))),
            ("stored after a refit", Box::new(stored(&refitted))),
            ("refitted", Box::new(refitted)),
        ];
        samplers.insert(0, ("default", Box::new(default)));
        let reference = ReferenceBvhLightSampler::new(&extents).expect(valid);
        let power = PowerLightSampler::new(&set.powers()).expect(valid);
        samplers.push(("reference", of_groups(reference, &groups)));
        samplers.push(("power", of_groups(power, &groups)));
        let uniform = UniformLightSampler::new(set.count());
        samplers.push(("uniform", of_groups(uniform, &groups)));
        if extents.len() <= FEW {
            let exhaustive = ExhaustiveLightSampler::new(&extents).expect(valid);
            samplers.push(("exhaustive", of_groups(exhaustive, &groups)));
        }
        Self {
            set,
            groups,
            samplers,
        }
    }

    /// Prototypes in their places, and after a refit that moves all of them.
    fn placed(case: &PlacedCase) -> Self {
        let mut refitted = case.sampler(&case.elsewhere());
        refitted
            .refit(&case.placements)
            .expect("as many placements");
        Self {
            set: case.case.clone(),
            groups: Vec::new(),
            samplers: vec![
                ("instanced", Box::new(case.sampler(&case.placements))),
                ("instanced, refitted", Box::new(refitted)),
            ],
        }
    }

    /// Whether a light is among those that the context asks for.
    pub(super) fn is_wanted(&self, light: LightId, ctx: &LightSampleContext) -> bool {
        let groups = self.groups.get(light.index());
        groups.is_none_or(|groups| groups.is_wanted(ctx.groups))
    }
}

/// Sets the groups, if there are any.
fn set_groups(sampler: &mut BvhLightSampler, groups: &[LightGroups]) {
    if !groups.is_empty() {
        sampler.set_groups(groups.to_vec()).expect("as many groups");
    }
}

/// A sampler without groups, restricted to those that a context asks for if there are any.
fn of_groups<S>(sampler: S, groups: &[LightGroups]) -> AnySampler
where
    S: LightSampler + Sync + Send + 'static,
{
    if groups.is_empty() {
        Box::new(sampler)
    } else {
        Box::new(GroupedLightSampler::new(sampler, groups.to_vec()))
    }
}
