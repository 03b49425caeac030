//! Each law of samplers finds the fault that it tests for.

use core::panic::AssertUnwindSafe;
use std::panic::catch_unwind;

use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_math::fraction;
use light_samplers::{LightChoices, LightSampler};
use light_testkit::SamplerCase;
use light_testkit::laws::sampler::{
    contributing_lights_can_be_chosen, frequencies_match_and_u_stays_uniform,
    invalid_queries_do_not_panic, pmfs_and_none_sum_to_one, sampled_pmf_is_the_queried_pmf,
    unknown_lights_have_no_pmf,
};
use light_testkit::laws::several_choices_follow_their_pmf;

/// A uniform choice with one fault.
struct Broken {
    count: u32,
    fault: Fault,
}

#[derive(Clone, Copy, PartialEq)]
enum Fault {
    None,
    HalfPmf,
    NeverTheLast,
    SameU,
    KnowsAll,
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
        let (light, rest) = fraction::choose(self.count, u);
        Some(SampledLight {
            light: LightId(light),
            pmf: 1.0 / self.count as f32,
            u: if self.fault == Fault::SameU { u } else { rest },
        })
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        let pmf = 1.0 / self.count as f32;
        match self.fault {
            Fault::HalfPmf => 0.5 * pmf,
            Fault::NeverTheLast if light.0 + 1 == self.count => 0.0,
            Fault::KnowsAll => pmf,
            _ if light.0 < self.count => pmf,
            _ => 0.0,
        }
    }
}

type Law = fn(&SamplerCase, &Broken);

fn holds(law: impl Fn(&SamplerCase, &Broken), fault: Fault) -> bool {
    let set = SamplerCase::mixed(9, 1);
    let count = set.count();
    catch_unwind(AssertUnwindSafe(|| law(&set, &Broken { count, fault }))).is_ok()
}

#[test]
fn laws_hold_for_a_right_sampler() {
    for law in [
        sampled_pmf_is_the_queried_pmf,
        pmfs_and_none_sum_to_one,
        contributing_lights_can_be_chosen,
        unknown_lights_have_no_pmf,
        frequencies_match_and_u_stays_uniform,
        invalid_queries_do_not_panic,
        several_choices_follow_their_pmf,
    ] {
        assert!(holds(law, Fault::None), "a law fails");
    }
}

#[test]
fn each_law_finds_its_fault() {
    let cases: [(Law, Fault); 7] = [
        (sampled_pmf_is_the_queried_pmf, Fault::HalfPmf),
        (pmfs_and_none_sum_to_one, Fault::HalfPmf),
        (contributing_lights_can_be_chosen, Fault::NeverTheLast),
        (unknown_lights_have_no_pmf, Fault::KnowsAll),
        (frequencies_match_and_u_stays_uniform, Fault::SameU),
        (several_choices_follow_their_pmf, Fault::HalfPmf),
        (several_choices_follow_their_pmf, Fault::SameU),
    ];
    for (i, (law, fault)) in cases.into_iter().enumerate() {
        assert!(!holds(law, fault), "case {i} goes unseen");
    }
}
