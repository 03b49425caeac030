use light_bounds::{LightExtent, LightId, LightSampleContext};
use light_math::fraction::stratum;
use light_samplers::LightSampler;

use super::choices::{Choice, Share};

/// How many lights are chosen at a receiver: one by itself, and several by a cut.
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
}

impl Kind {
    /// A sampler of which each light owns an interval.
    pub(super) const fn named(name: &'static str) -> Self {
        Self {
            name,
            share: Share::Interval,
        }
    }
}

/// All laws of a sampler that knows extents.
pub(super) fn check(
    kind: Kind,
    sampler: &impl LightSampler,
    lights: &[LightExtent],
    contexts: &[LightSampleContext],
    us: &[u64],
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
    for ctx in contexts {
        let choice = Choice {
            name: &format!("{name} at {ctx:?}"),
            sample: &|u| sampler.sample(ctx, u),
            pmf: &|light| sampler.pmf(ctx, light),
            count,
            share,
        };
        choice.shares_fill_the_unit(us);
        choice.contributing_lights_are_possible(lights, ctx);
        for k in COUNTS {
            check_several(kind, sampler, lights, ctx, us, k);
        }
    }
}

/// `k` choices at one receiver: one in each stratum, all with the same pmfs, which are those of
/// single choices if `k` is one.
fn check_several(
    kind: Kind,
    sampler: &impl LightSampler,
    lights: &[LightExtent],
    ctx: &LightSampleContext,
    us: &[u64],
    k: u32,
) {
    let here = sampler.at(ctx, k);
    let choice = Choice {
        name: &format!("{}: {k} choices at {ctx:?}", kind.name),
        sample: &|u| here.sample(u),
        pmf: &|light| here.pmf(light),
        count: lights.len() as u32,
        share: kind.share,
    };
    choice.shares_fill_the_unit(us);
    choice.contributing_lights_are_possible(lights, ctx);
    let name = choice.name;
    assert_eq!(here.count(), k, "{name}");
    let again = sampler.at(ctx, k);
    for &u in us {
        let one_by_one = (0..k).filter_map(|i| choice.checked(stratum(i, k, u)));
        assert!(here.samples(u).eq(one_by_one), "{name}: by strata of {u}");
        assert!(again.samples(u).eq(here.samples(u)), "{name}: again by {u}");
        if k == 1 {
            assert_eq!(here.sample(u), sampler.sample(ctx, u), "{name}: by {u}");
        }
    }
    if k == 1 {
        for id in (0..choice.count).map(LightId) {
            let pmfs = [here.pmf(id), sampler.pmf(ctx, id)].map(f32::to_bits);
            assert_eq!(pmfs[0], pmfs[1], "{name}: {id:?}");
        }
    }
}
