use light_bounds::{InfiniteBounds, LightExtent, LightId, LightSampleContext};
use light_bvh::{BuildMode, CutDetail, DarkLights, LightBvhOptions};
use light_samplers::{
    BvhLightSampler, BvhLightSamplerRef, ExhaustiveLightSampler, LightSampler, PowerLightSampler,
    ReferenceBvhLightSampler, UniformLightSampler,
};

use super::choices::{Choice, Share};
use super::input::Input;
use super::sampler_kind::{Kind, check, power};

/// Lights that one input may hold: enough for two levels of wide nodes.
const MAX_LIGHTS: usize = 24;

/// Every sampler obeys the laws for every receiver: bits of pmfs, sums, the rest of `u`, and no
/// light lost. The default one gives the same bits on borrowed memory.
///
/// # Panics
/// If a guarantee is violated.
pub fn samplers(data: &[u8]) {
    let mut input = Input::new(data);
    let options = options(&mut input);
    let detail = CutDetail::new(input.amount(10.0)).expect("a threshold from 0 on");
    let contexts = [input.receiver(), input.receiver()];
    let us = [input.fraction(), input.fraction()];
    let mut lights = Vec::new();
    while !input.is_empty() && lights.len() < MAX_LIGHTS {
        lights.push(input.scene_extent());
    }
    let tree = match BvhLightSampler::with_options(&lights, &options) {
        Ok(tree) => tree,
        Err(error) => panic!("a valid light is refused: {error}"),
    };
    let reference = ReferenceBvhLightSampler::new(&lights).expect("valid lights");
    let exhaustive = ExhaustiveLightSampler::new(&lights).expect("valid lights");
    let uniform = UniformLightSampler::new(lights.len() as u32);
    let powers: Vec<f32> = lights.iter().map(power).collect();
    let power = PowerLightSampler::new(&powers).expect("powers");
    check(Kind::named("default"), &tree, &lights, &contexts, &us);
    check(
        Kind::named("reference"),
        &reference,
        &lights,
        &contexts,
        &us,
    );
    check(
        Kind::named("exhaustive"),
        &exhaustive,
        &lights,
        &contexts,
        &us,
    );
    check(Kind::named("uniform"), &uniform, &lights, &contexts, &us);
    check_powers(&power, &lights, &contexts, &us);
    for ctx in &contexts {
        check_cut(&tree, detail, &lights, ctx, &us);
        check_borrowed(&tree, &lights, ctx, &us);
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
    us: &[u64],
) {
    let view = tree.tree().view();
    let cut = view.cut(ctx, detail);
    let choice = Choice {
        name: &format!("cut of {detail:?} at {ctx:?}"),
        sample: &|u| cut.sample(u),
        pmf: &|light| cut.pmf(light),
        count: lights.len() as u32,
        share: Share::Interval,
    };
    // The tree does not know the lights at infinity.
    let in_tree = |light: &LightExtent| match light.infinite() {
        Some(_) => LightExtent::Infinite(InfiniteBounds::uniform(0.0)),
        None => *light,
    };
    let lights: Vec<_> = lights.iter().map(in_tree).collect();
    choice.shares_fill_the_unit(us);
    choice.contributing_lights_are_possible(&lights, ctx);
    assert!(
        cut.irradiance() > 0.0 || choice.sum() == 0.0,
        "no irradiance by a cut of {detail:?} at {ctx:?}"
    );
}

/// The same sampler on borrowed memory gives the same bits.
fn check_borrowed(
    owned: &BvhLightSampler,
    lights: &[LightExtent],
    ctx: &LightSampleContext,
    us: &[u64],
) {
    let view = owned.view();
    let borrowed =
        BvhLightSamplerRef::new(view.tree(), owned.tree().power(), view.infinite_lights())
            .expect("what a sampler made");
    let pmfs = |sampler: &dyn LightSampler| -> Vec<[u32; 3]> {
        let several = sampler.at(ctx, 3);
        let ids = (0..=lights.len() as u32).map(LightId);
        ids.map(|id| {
            let pmfs = [
                sampler.pmf(ctx, id),
                sampler.pmf_emitter(id),
                several.pmf(id),
            ];
            pmfs.map(f32::to_bits)
        })
        .collect()
    };
    let expected = pmfs(owned);
    for sampler in [view, borrowed] {
        assert_eq!(pmfs(&sampler), expected, "borrowed at {ctx:?}");
        for &u in us {
            let choices = |sampler: &dyn LightSampler| {
                let several: Vec<_> = sampler.at(ctx, 3).samples(u).collect();
                (sampler.sample(ctx, u), sampler.sample_emitter(u), several)
            };
            assert_eq!(choices(&sampler), choices(owned), "by {u} at {ctx:?}");
        }
    }
}

/// The choice by power looks at no receiver, and never returns none; a light owns several intervals
/// of its `u`.
fn check_powers(
    sampler: &PowerLightSampler,
    lights: &[LightExtent],
    contexts: &[LightSampleContext],
    us: &[u64],
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
