use light_sets::SetKind;

use crate::SamplerCase;

/// The cases on which samplers are tried: generated ones of several sizes, and adversarial ones.
#[must_use]
pub fn sampler_cases() -> Vec<SamplerCase> {
    let mut sets = SamplerCase::adversarial(60);
    for n in [2, 9, 100] {
        sets.push(SamplerCase::generated(SetKind::Uniform, n, 21));
        sets.push(SamplerCase::generated(SetKind::Clusters, n, 22));
        sets.push(SamplerCase::generated(SetKind::Spots, n, 23));
        sets.push(SamplerCase::mixed(n, 24));
    }
    sets
}

/// Makes a module of tests, one a law, for the sampler that `$build` makes of a
/// [`SamplerCase`](crate::SamplerCase).
///
/// Belongs in a file of `tests/`: in unit tests the trait of the crate under test is another one.
///
/// ```
/// light_testkit::sampler_laws! {
///     /// Every light alike.
///     mod uniform {
///         |set| light_samplers::UniformLightSampler::new(set.count())
///     }
/// }
/// # fn main() {}
/// ```
#[macro_export]
macro_rules! sampler_laws {
    ($($(#[$meta:meta])* mod $name:ident { |$set:ident| $build:expr })+) => {$(
        $(#[$meta])*
        #[cfg(test)]
        mod $name {
            #[allow(
                unused_imports,
                reason = "not every way to build a sampler needs what the file imports"
            )]
            use super::*;

            fn build(
                $set: &$crate::SamplerCase,
            ) -> impl $crate::light_samplers::LightSampler + use<> {
                $build
            }

            fn check<S>(
                law: impl Fn(&$crate::SamplerCase, &S),
                build: impl Fn(&$crate::SamplerCase) -> S,
            ) {
                for set in $crate::laws::sampler_cases() {
                    law(&set, &build(&set));
                }
            }

            #[test]
            fn sampled_pmf_is_the_queried_pmf() {
                check($crate::laws::sampler::sampled_pmf_is_the_queried_pmf, build);
            }

            #[test]
            fn pmfs_and_none_sum_to_one() {
                check($crate::laws::sampler::pmfs_and_none_sum_to_one, build);
            }

            #[test]
            fn contributing_lights_can_be_chosen() {
                check($crate::laws::sampler::contributing_lights_can_be_chosen, build);
            }

            #[test]
            fn unknown_lights_have_no_pmf() {
                check($crate::laws::sampler::unknown_lights_have_no_pmf, build);
            }

            #[test]
            fn frequencies_match_and_u_stays_uniform() {
                check($crate::laws::sampler::frequencies_match_and_u_stays_uniform, build);
            }

            #[test]
            fn several_choices_follow_their_pmf() {
                check($crate::laws::several_choices_follow_their_pmf, build);
            }

            #[test]
            fn laws_hold_at_any_context() {
                check($crate::laws::sampler_contexts::laws_hold_at_any_context, build);
            }

            #[test]
            fn contributing_lights_can_be_chosen_whatever_the_normal() {
                use $crate::laws::sampler_contexts as laws;
                check(laws::contributing_lights_can_be_chosen_whatever_the_normal, build);
            }

            #[test]
            fn invalid_queries_do_not_panic() {
                check($crate::laws::sampler::invalid_queries_do_not_panic, build);
            }
        }
    )+};
}
