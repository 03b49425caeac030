//! Contexts that ask for some groups of lights: a light outside is never chosen, one inside is
//! where it contributes.

use light_samplers::light_bounds::glam::Vec3;
use light_samplers::light_bounds::light_math::Aabb;
use light_samplers::light_bounds::light_math::fraction::stratum;
use light_samplers::light_bounds::{
    InfiniteBounds, LightExtent, LightGroups, LightId, LightSampleContext,
};
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, GroupedLightSampler, LightSampler, PowerLightSampler,
    ReferenceBvhLightSampler, UniformLightSampler,
};

use crate::support::lamp_over_floor::{floor, lamp};

const LAMPS: u16 = 700;

/// Lamps, then a sun and a sky.
fn lights(phase: f32) -> Vec<LightExtent> {
    let lamps = (0..LAMPS).map(|i| match lamp(1.0 + f32::from(i % 9)) {
        LightExtent::Bounded(mut lamp) => {
            let angle = f32::from(i) + phase;
            let place = Vec3::new(angle.cos(), angle.sin(), 0.3) * (1.0 + f32::from(i));
            lamp.bounds = Aabb::from_point(place * 0.01);
            LightExtent::Bounded(lamp)
        }
        other => other,
    });
    let sun = LightExtent::Infinite(InfiniteBounds::distant(0.5, Vec3::Z));
    let sky = LightExtent::Infinite(InfiniteBounds::uniform(0.1));
    lamps.chain([sun, sky]).collect()
}

/// One lamp of 97 is in group 1, one of 5 in group 2, the sun in group 2, and the sky in none.
fn groups() -> Vec<LightGroups> {
    let of = |i: u16| {
        let is_in = |every: u16, index| match i % every {
            0 => LightGroups::of(index),
            _ => LightGroups::NONE,
        };
        is_in(97, 1) | is_in(5, 2)
    };
    let infinite = [LightGroups::of(2), LightGroups::NONE];
    (0..LAMPS).map(of).chain(infinite).collect()
}

/// The probabilities of all lights by a query, for one choice and for several.
fn pmfs(sampler: &impl LightSampler, ctx: &LightSampleContext) -> [Vec<f32>; 2] {
    let ids = || (0..u32::from(LAMPS) + 2).map(LightId);
    let here = sampler.at(ctx, 4);
    [
        ids().map(|id| sampler.pmf(ctx, id)).collect(),
        ids().map(|id| here.pmf(id)).collect(),
    ]
}

fn check(name: &str, sampler: &impl LightSampler) {
    let groups = groups();
    let asked = [1, 2, 3].map(LightGroups::of);
    let contexts = [
        floor(),
        LightSampleContext::medium(Vec3::splat(0.5)),
        LightSampleContext::segment(Vec3::ZERO, Vec3::ONE),
    ];
    for wanted in asked
        .into_iter()
        .chain([asked[0] | asked[1], LightGroups::ALL])
    {
        for all in contexts {
            let ctx = all.with_groups(wanted);
            for (of_all, pmfs) in pmfs(sampler, &all).into_iter().zip(pmfs(sampler, &ctx)) {
                for (groups, (pmf, of_all)) in groups.iter().zip(pmfs.iter().zip(of_all)) {
                    let may_light = of_all > 0.0 && groups.is_wanted(wanted);
                    assert_eq!(*pmf > 0.0, may_light, "{name}: {wanted:?} at {ctx:?}");
                }
                let sum: f64 = pmfs.iter().copied().map(f64::from).sum();
                assert!(sum < 1.0 + 1e-5, "{name}: {sum}");
            }
            let here = sampler.at(&ctx, 2);
            for u in (0..256).map(|i| stratum(i, 256, 1 << 63)) {
                for chosen in here.samples(u).chain(sampler.sample(&ctx, u)) {
                    let is_wanted = groups[chosen.light.index()].is_wanted(wanted);
                    assert!(is_wanted, "{name}: {chosen:?} for {wanted:?}");
                }
            }
        }
    }
}

#[test]
fn every_sampler_obeys() {
    let lights = lights(0.0);
    let mut bvh = BvhLightSampler::new(&lights).expect("valid lights");
    bvh.set_groups(groups()).expect("as many");
    check("bvh", &bvh);
    let count = u32::from(LAMPS) + 2;
    let uniform = GroupedLightSampler::new(UniformLightSampler::new(count), groups());
    check("uniform", &uniform);
    let powers = vec![1.0; usize::from(LAMPS) + 2];
    let power = PowerLightSampler::new(&powers).expect("powers");
    check_emitters(&power);
    check("power", &GroupedLightSampler::new(power, groups()));
    let exhaustive = ExhaustiveLightSampler::new(&lights).expect("valid lights");
    check(
        "exhaustive",
        &GroupedLightSampler::new(exhaustive, groups()),
    );
    let reference = ReferenceBvhLightSampler::new(&lights).expect("valid lights");
    check("reference", &GroupedLightSampler::new(reference, groups()));
}

/// Without a receiver nothing says which groups are asked for: all lights are.
fn check_emitters(power: &PowerLightSampler) {
    let grouped = GroupedLightSampler::new(power.clone(), groups());
    let here = power.at(&floor(), 1);
    for u in (0..300).map(|i| stratum(i, 300, 1 << 63)) {
        let chosen = grouped.sample_emitter(u).expect("all shine");
        assert_eq!(here.sample(u), Some(chosen), "as without groups");
        assert_eq!(here.pmf(chosen.light), chosen.pmf, "{chosen:?}");
        assert_eq!(grouped.pmf_emitter(chosen.light), chosen.pmf, "{chosen:?}");
    }
}

/// The tree chooses among the lights that are asked for: their probabilities sum to one.
#[test]
fn the_tree_wastes_no_choice_on_other_lights() {
    let mut sampler = BvhLightSampler::new(&lights(0.0)).expect("valid lights");
    sampler.set_groups(groups()).expect("as many");
    let ctx = floor().with_groups(LightGroups::of(1));
    for pmfs in pmfs(&sampler, &ctx) {
        let sum: f64 = pmfs.into_iter().map(f64::from).sum();
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");
    }
    let nobody = floor().with_groups(LightGroups::of(7));
    assert_eq!(
        sampler.sample(&nobody, 1 << 63),
        None,
        "no light in the group"
    );
}

#[test]
fn refits_keep_groups() {
    let mut sampler = BvhLightSampler::new(&lights(0.0)).expect("valid lights");
    sampler.set_groups(groups()).expect("as many");
    sampler.refit(&lights(1.0)).expect("as many");
    check("refitted", &sampler);
}

/// A context that asks for all lights gets the bits of a sampler without groups.
#[test]
fn groups_change_nothing_for_contexts_of_all_lights() {
    let plain = BvhLightSampler::new(&lights(0.0)).expect("valid lights");
    let mut grouped = plain.clone();
    grouped.set_groups(groups()).expect("as many");
    assert_eq!(
        pmfs(&plain, &floor()),
        pmfs(&grouped, &floor()),
        "all lights"
    );
    let error = grouped.set_groups(vec![LightGroups::ALL]);
    assert!(error.is_err(), "one entry for many lights");
}
