use light_bounds::{LightExtent, LightId, LightSampleContext};
use light_bvh::{BuildMode, CutDetail, DarkLights, LightBvhOptions};
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, LightSampler, PowerLightSampler,
    ReferenceBvhLightSampler, UniformLightSampler,
};

use super::choices::{Choice, Share};
use super::input::Input;
use super::sampler_kind::{Kind, check, power};

/// Lights that one input may hold: enough for two levels of wide nodes.
const MAX_LIGHTS: usize = 24;

/// Every sampler obeys the laws for every receiver: bits of pmfs, sums, the rest of `u`, and no
/// light lost.
///
/// # Panics
/// If a guarantee is violated.
pub fn samplers(data: &[u8]) {
    let mut input = Input::new(data);
    let options = options(&mut input);
    let detail = CutDetail::new(input.amount(10.0)).expect("a threshold from 0 on");
    let contexts = [input.receiver(), input.receiver()];
    let us = [input.unit(), input.unit()].map(f64::from);
    let mut lights = Vec::new();
    while !input.is_empty() && lights.len() < MAX_LIGHTS {
        lights.push(input.scene_extent());
    }
    let tree = match BvhLightSampler::with(&lights, &options) {
        Ok(tree) => tree,
        Err(error) => panic!("a valid light is refused: {error}"),
    };
    let reference = ReferenceBvhLightSampler::new(&lights).expect("valid lights");
    let exhaustive = ExhaustiveLightSampler::new(&lights).expect("valid lights");
    let uniform = UniformLightSampler::new(lights.len() as u32);
    let powers: Vec<f32> = lights.iter().map(power).collect();
    let power = PowerLightSampler::new(&powers).expect("powers");
    check(
        Kind::default_named("default"),
        &tree,
        &lights,
        &contexts,
        &us,
    );
    check(
        Kind::at_start("reference", Share::Interval),
        &reference,
        &lights,
        &contexts,
        &us,
    );
    check(
        Kind::at_start("exhaustive", Share::Scattered),
        &exhaustive,
        &lights,
        &contexts,
        &us,
    );
    check(
        Kind::at_start("uniform", Share::Interval),
        &uniform,
        &lights,
        &contexts,
        &us,
    );
    check_powers(&power, &lights, &contexts, &us);
    for ctx in &contexts {
        check_cut(&tree, detail, &lights, ctx, &us);
    }
}

/// How a tree is built.
pub(super) fn options(input: &mut Input<'_>) -> LightBvhOptions {
    let kind = input.byte();
    LightBvhOptions {
        mode: if kind & 1 == 0 {
            BuildMode::Binned
        } else {
            BuildMode::Morton
        },
        dark: if kind & 2 == 0 {
            DarkLights::LeftOut
        } else {
            DarkLights::Kept
        },
    }
}

/// A cut of its own detail.
fn check_cut(
    tree: &BvhLightSampler,
    detail: CutDetail,
    lights: &[LightExtent],
    ctx: &LightSampleContext,
    us: &[f64],
) {
    let cut = tree.cut(ctx, detail);
    let choice = Choice {
        name: &format!("cut of {detail:?} at {ctx:?}"),
        sample: &|u| cut.sample(u),
        pmf: &|light| cut.pmf(light),
        count: lights.len() as u32,
        share: Share::Interval,
    };
    choice.shares_fill_the_unit(us);
    choice.contributing_lights_are_possible(lights, ctx);
    let mut many = Vec::new();
    cut.sample_many(us[0], 4, &mut |light| many.push(light));
    for chosen in many {
        let asked = cut.pmf(chosen.light);
        assert_eq!(chosen.pmf.to_bits(), asked.to_bits(), "{chosen:?} of a cut");
    }
}

/// The choice by power looks at no receiver, and never returns none; a light owns several intervals
/// of its `u`.
fn check_powers(
    sampler: &PowerLightSampler,
    lights: &[LightExtent],
    contexts: &[LightSampleContext],
    us: &[f64],
) {
    for ctx in contexts {
        let choice = Choice {
            name: "power",
            sample: &|u| sampler.sample(ctx, u),
            pmf: &|light| sampler.pmf(ctx, light),
            count: lights.len() as u32,
            share: Share::Scattered,
        };
        let sum = choice.sum();
        assert!(
            (sum - 1.0).abs() <= 2e-5 || lights.is_empty(),
            "power: the pmfs sum to {sum}"
        );
        for &u in us {
            let chosen = choice.checked(u);
            assert_eq!(chosen.is_none(), lights.is_empty(), "power: none at {u}");
        }
        choice.contributing_lights_are_possible(lights, ctx);
        for (id, light) in (0..).map(LightId).zip(lights) {
            let is_possible = sampler.pmf_emitter(id) > 0.0;
            assert!(is_possible || !(power(light) > 0.0), "power: {light:?}");
        }
    }
}
