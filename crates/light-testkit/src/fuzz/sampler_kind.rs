use core::cell::RefCell;

use light_bounds::{LightExtent, LightId, LightSampleContext};
use light_math::glam::Vec3;
use light_samplers::{LightSampler, PreparedChoices};

use super::choices::{Choice, Share};
use crate::may_contribute;

/// How many lights are chosen at once: one by itself, and several by a cut.
const COUNTS: [u32; 2] = [1, 3];

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
    name: &'static str,
    /// What each light owns.
    share: Share,
    segments: Segments,
}

/// How a ray segment is received.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Segments {
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

    pub(super) const fn at_start(name: &'static str, share: Share) -> Self {
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

/// `k` choices at once, and their pmfs with and without prepared choices.
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
