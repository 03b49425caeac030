//! Each law of samplers finds the fault that it tests for.

use core::any::Any;
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
    ChoosesUnknown,
    /// Nothing is chosen for one `u` of 256, although the pmfs add up to one.
    LosesSome,
    /// None: two of five choices.
    MakesFewer,
    MakesMore,
    MakesNone,
}

impl LightSampler for Broken {
    fn sample(&self, _: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.sample_emitter(u)
    }

    fn pmf(&self, _: &LightSampleContext, light: LightId) -> f32 {
        self.pmf_emitter(light)
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        let choices = LightChoices::one_by_one(self, ctx, count);
        match self.fault {
            Fault::MakesFewer => choices.with_count(count.min(2)),
            Fault::MakesMore => choices.with_count(count + 1),
            Fault::MakesNone => choices.with_count(0),
            _ => choices,
        }
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        if self.fault == Fault::LosesSome && fraction::choose(256, u).0 == 100 {
            return None;
        }
        let (light, rest) = fraction::choose(self.count, u);
        let beyond = u32::from(self.fault == Fault::ChoosesUnknown);
        Some(SampledLight {
            light: LightId(light + beyond),
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

/// The message of a law that does not hold.
fn failure(law: Law, fault: Fault) -> Option<String> {
    let set = SamplerCase::mixed(9, 1);
    let count = set.count();
    let result = catch_unwind(AssertUnwindSafe(|| law(&set, &Broken { count, fault })));
    let said = |cause: Box<dyn Any + Send>| *cause.downcast::<String>().expect("a message");
    result.err().map(said)
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
        assert_eq!(failure(law, Fault::None), None, "a law fails");
    }
}

#[test]
fn fewer_choices_than_asked_for_are_no_fault() {
    let law = several_choices_follow_their_pmf;
    assert_eq!(failure(law, Fault::MakesFewer), None, "two of five");
}

#[test]
fn each_law_finds_its_fault() {
    const WRONG_PMF: &str = "but the queried pmf is";
    const WRONG_U: &str = "the rest of u is not uniform for light";
    const UNKNOWN: &str = "of an unknown light";
    let frequencies = frequencies_match_and_u_stays_uniform;
    let several = several_choices_follow_their_pmf;
    let cases: [(Law, Fault, &str); 16] = [
        (sampled_pmf_is_the_queried_pmf, Fault::HalfPmf, WRONG_PMF),
        (
            sampled_pmf_is_the_queried_pmf,
            Fault::ChoosesUnknown,
            UNKNOWN,
        ),
        (pmfs_and_none_sum_to_one, Fault::HalfPmf, "the pmfs sum to"),
        (
            pmfs_and_none_sum_to_one,
            Fault::LosesSome,
            "none is returned with",
        ),
        (frequencies, Fault::LosesSome, "were chosen"),
        (
            contributing_lights_can_be_chosen,
            Fault::NeverTheLast,
            "is never chosen",
        ),
        (
            unknown_lights_have_no_pmf,
            Fault::KnowsAll,
            "pmf of unknown light",
        ),
        (frequencies, Fault::SameU, WRONG_U),
        (frequencies, Fault::HalfPmf, "were chosen"),
        (frequencies, Fault::ChoosesUnknown, UNKNOWN),
        (invalid_queries_do_not_panic, Fault::ChoosesUnknown, UNKNOWN),
        (several, Fault::HalfPmf, WRONG_PMF),
        (several, Fault::SameU, WRONG_U),
        (several, Fault::ChoosesUnknown, UNKNOWN),
        (several, Fault::MakesMore, "more than asked for"),
        (several, Fault::MakesNone, "none is made"),
    ];
    for (i, (law, fault, words)) in cases.into_iter().enumerate() {
        let said = failure(law, fault).unwrap_or_default();
        assert!(said.contains(words), "case {i}: {words:?}, not {said:?}");
    }
}
