//! The choice between the tree and the lights at infinity follows a refit, and every method gives
//! the same probabilities.

use light_samplers::light_bounds::glam::Vec3;
use light_samplers::light_bounds::light_math::Aabb;
use light_samplers::light_bounds::{InfiniteBounds, LightExtent, LightId};
use light_samplers::{
    BvhLightSampler, BvhLightSamplerRef, LightChoices, LightSampler, SampledLight,
};

use crate::support::lamp_over_floor::{floor, lamp};

fn lights(phi: f32, radiance: f32) -> [LightExtent; 2] {
    let sky = LightExtent::Infinite(InfiniteBounds::uniform(radiance));
    [lamp(phi), sky]
}

/// All probabilities of a sampler of two lights, as bits.
fn pmfs(sampler: &BvhLightSampler) -> [[u32; 2]; 3] {
    let ids = [0, 1].map(LightId);
    [
        ids.map(|id| sampler.pmf(&floor(), id).to_bits()),
        ids.map(|id| sampler.at(&floor(), 4).pmf(id).to_bits()),
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
fn samples_have_the_bits_of_their_queries() {
    let sampler = BvhLightSampler::new(&lights(10.0, 0.5)).expect("valid lights");
    for count in [1, 2, 5] {
        let here = sampler.at(&floor(), count);
        let again = sampler.at(&floor(), count);
        for id in [0, 1].map(LightId) {
            let pmf = here.pmf(id);
            assert_eq!(pmf, again.pmf(id), "{id:?} of {count}");
            assert!(pmf > 0.1 && pmf < 0.9, "both count: {pmf}");
        }
        let samples: Vec<SampledLight> = here.samples(1 << 62).collect();
        assert_eq!(samples.len(), count as usize, "each choice finds a light");
        assert!(
            samples.iter().copied().eq(again.samples(1 << 62)),
            "{count} choices"
        );
        for sample in samples {
            assert_eq!(sample.pmf, here.pmf(sample.light), "{sample:?} of {count}");
        }
    }
}

/// The sampler on borrowed memory, from parts that could lie in flash.
#[test]
fn a_borrowed_sampler_is_the_sampler() {
    let sampler = BvhLightSampler::new(&lights(10.0, 0.5)).expect("valid lights");
    let view = sampler.view();
    let (tree, power) = (sampler.tree().view(), sampler.tree().power());
    let stored = view.infinite_lights().to_vec();
    let borrowed = BvhLightSamplerRef::new(tree, power, &stored).expect("one sky");
    for id in [0, 1].map(LightId) {
        assert_eq!(
            borrowed.pmf(&floor(), id),
            sampler.pmf(&floor(), id),
            "{id:?}"
        );
        assert_eq!(borrowed.pmf_emitter(id), sampler.pmf_emitter(id), "{id:?}");
    }
    for u in [0, 1 << 62, 1 << 63, u64::MAX] {
        assert_eq!(
            borrowed.sample(&floor(), u),
            sampler.sample(&floor(), u),
            "{u}"
        );
        assert_eq!(borrowed.sample_emitter(u), sampler.sample_emitter(u), "{u}");
        let (ours, theirs) = (borrowed.at(&floor(), 3), sampler.at(&floor(), 3));
        assert!(ours.samples(u).eq(theirs.samples(u)), "{u}");
    }
}

/// One lamp and the sky: the probabilities of several choices add up to one, as those of one do.
#[test]
fn probabilities_of_several_choices_add_up() {
    for (phi, radiance) in [(10.0, 0.5), (10.0, 0.0), (0.0, 0.5)] {
        let sampler = BvhLightSampler::new(&lights(phi, radiance)).expect("valid lights");
        for count in [1, 2, 7] {
            let here = sampler.at(&floor(), count);
            let pmf = |id| f64::from(here.pmf(LightId(id)));
            assert!(
                (pmf(0) + pmf(1) - 1.0).abs() < 1e-6,
                "{count}: {} {}",
                pmf(0),
                pmf(1)
            );
        }
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
        let pmf = |count| sampler.at(&floor(), count).pmf(id);
        let one = sampler.pmf(&floor(), id);
        assert_eq!(pmf(1).to_bits(), one.to_bits(), "{id:?}");
        differ += usize::from(pmf(16) != one);
    }
    assert!(differ > 100, "a cut of 16 differs for {differ} lights");
}

#[test]
fn many_lamps_have_the_pmf_of_their_choices() {
    let sampler = BvhLightSampler::new(&many_lamps()).expect("valid lights");
    for count in [1, 2, 3, 16] {
        let here = sampler.at(&floor(), count);
        for sample in here.samples(1 << 62) {
            assert_eq!(sample.pmf, here.pmf(sample.light), "{sample:?} of {count}");
        }
    }
}

#[test]
fn choices_made_in_place_do_not_depend_on_what_was_there() {
    let row: Vec<LightExtent> = (0..300).map(|k| lamp_at(k as f32 - 20.0)).collect();
    let sampler = BvhLightSampler::new(&row).expect("valid lights");
    let sampler = sampler.view();
    let mut here = LightChoices::default();
    assert_eq!((here.count(), here.samples(0).count()), (0, 0), "none");
    assert_eq!(here.pmf(LightId(0)), 0.0, "of no choice");
    // By a cut, from the root, and by a cut again.
    for count in [5, 1, 4, 1, 2] {
        sampler.set_at(&floor(), count, &mut here);
        let made = sampler.at(&floor(), count);
        assert_eq!(here.count(), count);
        assert!(
            here.samples(1 << 61).eq(made.samples(1 << 61)),
            "{count} choices"
        );
        for id in (0..300).map(LightId) {
            assert_eq!(here.pmf(id), made.pmf(id), "{id:?} of {count}");
        }
    }
}

/// A lamp beside the one of the pair.
fn lamp_at(x: f32) -> LightExtent {
    match lamp(1.0) {
        LightExtent::Bounded(mut lamp) => {
            lamp.bounds = Aabb::from_point(Vec3::new(x, 0.0, 2.0));
            LightExtent::Bounded(lamp)
        }
        infinite => infinite,
    }
}
