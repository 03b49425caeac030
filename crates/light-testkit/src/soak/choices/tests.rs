use super::*;
use crate::SamplerCase;
use light_math::glam::Vec3;
use light_samplers::LightChoices;

/// A uniform choice of four lights that leaves the same `u`, or states another pmf.
#[derive(Clone, Copy, PartialEq)]
enum Broken {
    Right,
    SameU,
    OtherPmf,
    NoPmf,
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
        match self {
            Self::OtherPmf => 0.2,
            Self::NoPmf => 0.0,
            Self::Right | Self::SameU => 0.25,
        }
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
            set: None,
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

#[test]
fn other_groups_wrong_zeros_and_large_sums_are_counted() {
    let groups = [0, 1, 1, 1].map(LightGroups::of);
    let set = SoakSet::new(SamplerCase::mixed(4, 1), groups.to_vec());
    let ctx = LightSampleContext::medium(Vec3::ZERO).with_groups(LightGroups::of(0));
    let mismatches = |sampler: Broken, known, ask: &dyn Fn(&mut SoakQuery<'_>)| {
        let mut row = Row::default();
        ask(&mut SoakQuery {
            name: "broken",
            sampler: &sampler,
            set: Some(&set),
            known,
            ctx: &ctx,
            row: &mut row,
        });
        row.mismatches
    };
    let [ours, other] = [0, 1].map(LightId);
    let right = |ask: &dyn Fn(&mut SoakQuery<'_>)| mismatches(Broken::Right, 4, ask);
    assert_eq!(right(&|query| query.single(0)), 0, "asked for");
    assert_eq!(right(&|query| query.single(1 << 63)), 1, "not asked for");
    assert_eq!(right(&|query| query.contribution(ours)), 0, "a pmf");
    assert_eq!(right(&|query| query.contribution(other)), 1, "no pmf");
    let lost = mismatches(Broken::NoPmf, 4, &|query| query.contribution(ours));
    assert_eq!(lost, 1, "a light is lost");
    assert_eq!(right(&|query| query.sum()), 0, "one");
    let two = mismatches(Broken::Right, 8, &|query| query.sum());
    assert_eq!(two, 1, "two");
}
