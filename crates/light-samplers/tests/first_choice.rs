//! The choice between the tree and the lights at infinity follows a refit, and every method gives
//! the same probabilities.
#![cfg(feature = "alloc")]

#[path = "support/lamp_over_floor.rs"]
mod lamp_over_floor;

use lamp_over_floor::{floor, lamp};
use light_samplers::light_bounds::glam::Vec3;
use light_samplers::light_bounds::light_math::Aabb;
use light_samplers::light_bounds::{InfiniteBounds, LightExtent, LightId};
use light_samplers::{BvhLightSampler, LightSampler, PreparedChoices};

fn lights(phi: f32, radiance: f32) -> [LightExtent; 2] {
    let sky = LightExtent::Infinite(InfiniteBounds::uniform(radiance));
    [lamp(phi), sky]
}

/// All probabilities of a sampler of two lights, as bits.
fn pmfs(sampler: &BvhLightSampler) -> [[u32; 2]; 3] {
    let ids = [0, 1].map(LightId);
    [
        ids.map(|id| sampler.pmf(&floor(), id).to_bits()),
        ids.map(|id| sampler.pmf_many(&floor(), id, 4).to_bits()),
        ids.map(|id| sampler.pmf_emitter(id).to_bits()),
    ]
}

#[test]
fn a_refit_knows_the_new_sky_and_the_new_power() {
    let mut sampler = BvhLightSampler::new(&lights(10.0, 0.1)).expect("valid lights");
    for (phi, radiance) in [(10.0, 5.0), (3000.0, 5.0), (1.0, 1e-4), (1.0, 0.0)] {
        let changed = lights(phi, radiance);
        sampler.refit(&changed).expect("as many lights");
        let rebuilt = BvhLightSampler::new(&changed).expect("valid lights");
        assert_eq!(pmfs(&sampler), pmfs(&rebuilt), "{phi} W, {radiance}");
    }
}

#[test]
fn what_was_looked_at_gives_the_bits_of_a_new_look() {
    let sampler = BvhLightSampler::new(&lights(10.0, 0.5)).expect("valid lights");
    for count in [1, 2, 5] {
        let mut prepared = PreparedChoices::default();
        let mut chosen = Vec::new();
        sampler.sample_many_prepared(&floor(), 0.3, count, &mut prepared, &mut |s| chosen.push(s));
        for id in [0, 1].map(LightId) {
            let looked = sampler.pmf_many_prepared(&floor(), id, count, &prepared);
            assert_eq!(
                looked,
                sampler.pmf_many(&floor(), id, count),
                "{id:?} of {count}"
            );
            assert!(looked > 0.1 && looked < 0.9, "both count: {looked}");
        }
        for sample in chosen {
            let pmf = sampler.pmf_many(&floor(), sample.light, count);
            assert_eq!(sample.pmf, pmf, "{sample:?} of {count}");
        }
    }
}

/// One lamp and the sky: the probabilities of several choices add up to one, as those of one do.
#[test]
fn probabilities_of_several_choices_add_up() {
    for (phi, radiance) in [(10.0, 0.5), (10.0, 0.0), (0.0, 0.5)] {
        let sampler = BvhLightSampler::new(&lights(phi, radiance)).expect("valid lights");
        for count in [1, 2, 7] {
            let pmf = |id| f64::from(sampler.pmf_many(&floor(), LightId(id), count));
            assert!(
                (pmf(0) + pmf(1) - 1.0).abs() < 1e-6,
                "{count}: {} {}",
                pmf(0),
                pmf(1)
            );
        }
    }
}

#[test]
fn several_choices_without_a_kept_look_are_the_same_choices() {
    let sampler = BvhLightSampler::new(&lights(10.0, 0.5)).expect("valid lights");
    for count in [1, 2, 5] {
        let (mut looking, mut plain) = (Vec::new(), Vec::new());
        let mut prepared = PreparedChoices::default();
        sampler.sample_many_prepared(&floor(), 0.3, count, &mut prepared, &mut |s| {
            looking.push(s)
        });
        sampler.sample_many(&floor(), 0.3, count, &mut |s| plain.push(s));
        assert_eq!(plain.len(), count as usize, "each choice finds a light");
        assert_eq!(plain, looking, "{count} choices");
    }
}

/// Lamps of other powers in other places.
fn many_lamps() -> Vec<LightExtent> {
    let lamps = (0..200u8).map(|i| match lamp(1.0 + f32::from(i)) {
        LightExtent::Bounded(mut lamp) => {
            lamp.bounds = Aabb::from_point(Vec3::new(f32::from(i), 1.0, 2.0));
            LightExtent::Bounded(lamp)
        }
        other => other,
    });
    lamps.collect()
}

/// A cut is more precise than a single choice, so that the two have different probabilities.
#[test]
fn the_pmf_of_one_choice_is_that_of_a_single_sample() {
    let sampler = BvhLightSampler::new(&many_lamps()).expect("valid lights");
    let mut differ = 0;
    for id in (0..200).map(LightId) {
        let pmf = |count| {
            let prepared = PreparedChoices::default();
            sampler.pmf_many_prepared(&floor(), id, count, &prepared)
        };
        let one = sampler.pmf(&floor(), id);
        assert_eq!(pmf(1).to_bits(), one.to_bits(), "{id:?}");
        differ += usize::from(pmf(16) != one);
    }
    assert!(differ > 100, "a cut of 16 differs for {differ} lights");
}

/// Prepared choices give the probabilities of the choices that filled them.
#[test]
fn many_lamps_have_the_pmf_of_their_choices() {
    let sampler = BvhLightSampler::new(&many_lamps()).expect("valid lights");
    for count in [1, 2, 3, 16] {
        let (mut chosen, mut prepared) = (Vec::new(), PreparedChoices::default());
        sampler.sample_many_prepared(&floor(), 0.3, count, &mut prepared, &mut |s| chosen.push(s));
        for sample in chosen {
            let looked = sampler.pmf_many_prepared(&floor(), sample.light, count, &prepared);
            assert_eq!(sample.pmf, looked, "{sample:?} of {count}, by the prepared");
            let pmf = sampler.pmf_many(&floor(), sample.light, count);
            assert_eq!(sample.pmf, pmf, "{sample:?} of {count}");
        }
    }
}
