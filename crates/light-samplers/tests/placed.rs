//! Prototypes that are placed several times, against lights where they are placed.

use light_samplers::InstancedBvhLightSampler;
use light_samplers::light_bounds::LightId;
use light_samplers::light_bvh::{InstancedLightBvhError, PlacedLight};
use light_testkit::laws::{sampler as laws, several_choices_follow_their_pmf};
use light_testkit::{PlacedCase, SamplerCase};

/// Placements of a village.
const COUNT: usize = 20;

fn laws(set: &SamplerCase, sampler: &InstancedBvhLightSampler) {
    laws::sampled_pmf_is_the_queried_pmf(set, sampler);
    laws::pmfs_and_none_sum_to_one(set, sampler);
    laws::contributing_lights_can_be_chosen(set, sampler);
    laws::unknown_lights_have_no_pmf(set, sampler);
    laws::frequencies_match_and_u_stays_uniform(set, sampler);
    laws::invalid_queries_do_not_panic(set, sampler);
    several_choices_follow_their_pmf(set, sampler);
}

#[test]
fn laws_hold_for_many_placements() {
    for seed in 1..5 {
        let village = PlacedCase::village(COUNT, seed);
        laws(&village.case, &village.sampler(&village.placements));
    }
}

#[test]
fn laws_hold_after_a_refit() {
    let village = PlacedCase::village(COUNT, 5);
    let placements = &village.placements;
    let mut moved = village.sampler(&village.elsewhere());
    let error = moved.refit(&placements[1..]).err();
    let expected = placements.len();
    let missing = InstancedLightBvhError::OtherPlacements { expected };
    assert_eq!(error, Some(missing), "one is missing");
    let mut exchanged = placements.clone();
    exchanged.swap(0, 1);
    let error = moved.refit(&exchanged).err();
    let other = InstancedLightBvhError::Prototype { placement: 0 };
    assert_eq!(error, Some(other), "another prototype");
    moved.refit(placements).expect("the same prototypes");
    laws(&village.case, &moved);
}

#[test]
fn ids_are_positions() {
    let village = PlacedCase::village(COUNT, 7);
    let (set, sampler) = (&village.case, village.sampler(&village.placements));
    let tree = sampler.tree();
    assert_eq!(
        tree.light_count() + 1,
        u64::from(set.count()),
        "and the sky"
    );
    for id in 0..set.count() - 1 {
        let light = sampler.placed_light(LightId(id)).expect("a light");
        assert_eq!(tree.light_index(light), Some(u64::from(id)), "{light:?}");
    }
    assert_eq!(sampler.placed_light(LightId(set.count() - 1)), None, "sky");
    let none = PlacedLight {
        placement: 1000,
        light: LightId(0),
    };
    assert_eq!(tree.pmf(&set.contexts[0], none), 0.0, "no such placement");
}
