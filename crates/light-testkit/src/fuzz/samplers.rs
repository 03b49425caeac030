use core::cell::RefCell;

use light_bounds::{LightExtent, LightId, LightSampleContext};
use light_bvh::{BuildMode, CutDetail, DarkLights, LightBvhOptions};
use light_math::glam::Vec3;
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, LightSampler, PowerLightSampler, PreparedChoices,
    ReferenceBvhLightSampler, UniformLightSampler,
};

use super::choices::{Choice, Share};
use super::input::Input;
use crate::may_contribute;

/// Lights that one input may hold: enough for two levels of wide nodes.
const MAX_LIGHTS: usize = 24;

/// How many lights are chosen at once: one by itself, and several by a cut.
const COUNTS: [u32; 2] = [1, 3];

/// Every sampler obeys the laws for every receiver: bits of pmfs, sums, the rest of `u`, and no
/// light lost.
///
/// # Panics
/// If a promise is broken.
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

/// What a light emits.
pub(super) fn power(light: &LightExtent) -> f32 {
    match light {
        LightExtent::Bounded(bounds) => bounds.phi,
        LightExtent::Lobe(_, lobe) => lobe.power,
        LightExtent::Infinite(bounds) => bounds.fluence,
    }
}

/// What sets samplers apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kind {
    pub(super) name: &'static str,
    /// What each light owns.
    pub(super) share: Share,
    /// How a ray segment is received.
    pub(super) segments: Segments,
}

/// How a ray segment is received.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Segments {
    /// Along all of it.
    Whole,
    /// At its first point.
    Start,
}

impl Kind {
    /// The default sampler, under a name of its own.
    pub(super) const fn default_named(name: &'static str) -> Self {
        Self {
            name,
            share: Share::Interval,
            segments: Segments::Whole,
        }
    }

    const fn at_start(name: &'static str, share: Share) -> Self {
        Self {
            name,
            share,
            segments: Segments::Start,
        }
    }
}

/// All laws of a sampler that knows extents.
pub(super) fn check(
    kind: Kind,
    sampler: &impl LightSampler,
    lights: &[LightExtent],
    contexts: &[LightSampleContext],
    us: &[f64],
) {
    let (count, name, share) = (lights.len() as u32, kind.name, kind.share);
    Choice {
        name: &format!("{name}, emitter"),
        sample: &|u| sampler.sample_emitter(u),
        pmf: &|light| sampler.pmf_emitter(light),
        count,
        share,
    }
    .shares_fill_the_unit(us);
    for (id, light) in (0..).map(LightId).zip(lights) {
        assert!(
            sampler.pmf_emitter(id) > 0.0 || !(power(light) > 0.0),
            "{name}: {id:?} emits and is never chosen to: {light:?}"
        );
    }
    let prepared = RefCell::new(PreparedChoices::default());
    for ctx in contexts {
        let choice = Choice {
            name: &format!("{name} at {ctx:?}"),
            sample: &|u| sampler.sample(ctx, u),
            pmf: &|light| sampler.pmf(ctx, light),
            count,
            share,
        };
        choice.shares_fill_the_unit(us);
        choice.contributing_lights_are_possible(lights, &received(kind, ctx));
        for k in COUNTS {
            check_many(kind, sampler, lights, ctx, us, k, &prepared);
        }
    }
}

/// The context for which the sampler chooses.
fn received(kind: Kind, ctx: &LightSampleContext) -> LightSampleContext {
    match kind.segments {
        Segments::Whole => *ctx,
        Segments::Start => LightSampleContext {
            segment: Vec3::ZERO,
            ..*ctx
        },
    }
}

/// `k` choices at once, and their pmfs with and without a prepared.
fn check_many(
    kind: Kind,
    sampler: &impl LightSampler,
    lights: &[LightExtent],
    ctx: &LightSampleContext,
    us: &[f64],
    k: u32,
    prepared: &RefCell<PreparedChoices>,
) {
    let name = kind.name;
    let received = received(kind, ctx);
    for &u in us {
        let mut plain = Vec::new();
        sampler.sample_many(ctx, u, k, &mut |light| plain.push(light));
        let mut looked = Vec::new();
        let prepared = &mut *prepared.borrow_mut();
        sampler.sample_many_prepared(ctx, u, k, prepared, &mut |light| looked.push(light));
        assert_eq!(
            plain, looked,
            "{name}: {k} lights with a prepared at {ctx:?}"
        );
        assert!(
            plain.len() <= k as usize,
            "{name}: more than {k} at {ctx:?}"
        );
        for chosen in &plain {
            let asked = sampler.pmf_many(ctx, chosen.light, k);
            assert!(
                chosen.pmf.to_bits() == asked.to_bits()
                    && chosen.pmf > 0.0
                    && (0.0..1.0).contains(&chosen.u),
                "{name}: {chosen:?} of {k}, but the queried pmf is {asked} at {ctx:?}"
            );
        }
        let mut sum = 0.0;
        for (id, light) in (0..).map(LightId).zip(lights) {
            let pmf = sampler.pmf_many(ctx, id, k);
            let with_look = sampler.pmf_many_prepared(ctx, id, k, prepared);
            let without = sampler.pmf_many_prepared(ctx, id, k, &PreparedChoices::default());
            assert!(
                pmf.to_bits() == with_look.to_bits() && pmf.to_bits() == without.to_bits(),
                "{name}: {pmf}, {with_look} and {without} of {id:?} and {k} at {ctx:?}"
            );
            assert!(
                pmf > 0.0 || !may_contribute(light, &received),
                "{name}: {id:?} may contribute and has pmf {pmf} of {k}: {light:?} at {ctx:?}"
            );
            sum += f64::from(pmf);
        }
        assert!(
            sum <= 1.0 + 2e-5,
            "{name}: pmfs of {k} sum to {sum} at {ctx:?}"
        );
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
