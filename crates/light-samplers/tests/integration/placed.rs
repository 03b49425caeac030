//! Prototypes that are placed several times, against lights where they are placed.

use light_samplers::InstancedBvhLightSampler;
use light_samplers::light_bounds::glam::Vec3;
use light_samplers::light_bounds::{InfiniteBounds, LightId};
use light_samplers::light_bvh::{
    InstancedLightBvh, InstancedLightBvhError, LightPrototype, PlacedLight, Placement,
};
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
        // All, some, or none are opened.
        for most_opened in [usize::MAX, 100, 0] {
            let sampler = village.sampler_opening(&village.placements, most_opened);
            laws(&village.case, &sampler);
        }
    }
}

#[test]
fn laws_hold_after_a_refit() {
    let village = PlacedCase::village(COUNT, 5);
    for most_opened in [usize::MAX, 100, 0] {
        refitted(&village, most_opened);
    }
}

/// The laws hold for a village that was built elsewhere.
fn refitted(village: &PlacedCase, most_opened: usize) {
    let placements = &village.placements;
    let mut moved = village.sampler_opening(&village.elsewhere(), most_opened);
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

/// A prototype of all lights has places for those at infinity, where it is dark.
#[test]
fn lights_at_infinity_may_be_among_those_of_a_prototype() {
    let set = SamplerCase::mixed(60, 9);
    let all = set.extents();
    let whole = LightPrototype::new(&all).expect("valid lights");
    let tree = || {
        let whole = vec![whole.clone()];
        InstancedLightBvh::build(whole, &[Placement::at(0, Vec3::ZERO)]).expect("one place")
    };
    let ids = (0..).map(LightId).zip(&all);
    let infinite: Vec<_> = ids
        .filter_map(|(id, extent)| Some((id, *extent.infinite()?)))
        .collect();
    assert_eq!(infinite.len(), 2, "a sky and a sun");
    let sampler = InstancedBvhLightSampler::with_infinite_among(tree(), &infinite);
    laws(&set, &sampler.expect("a sky and a sun among the lights"));

    let error = |infinite: &[_]| {
        InstancedBvhLightSampler::with_infinite_among(tree(), infinite)
            .err()
            .map(|error| error.to_string())
    };
    let (id, sky) = infinite[0];
    let order = Some("lights at infinity: expected ids of the tree, in ascending order".into());
    assert_eq!(error(&[(id, sky), (id, sky)]), order, "twice");
    assert_eq!(error(&[(LightId(set.count()), sky)]), order, "beyond");
    let bad = InfiniteBounds {
        fluence: f32::NAN,
        ..sky
    };
    let words = error(&[(id, bad)]).expect("no number");
    assert!(words.starts_with(&format!("light {}: ", id.0)), "{words}");
}
