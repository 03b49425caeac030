//! Three lights whose probabilities follow from their powers: two lamps of 1 W and 3 W in one
//! place, and a sun.

use light_bvh::LightBvhOptions;
use light_samplers::light_bounds::glam::Vec3;
use light_samplers::light_bounds::light_math::fraction::{stratum, to_f64};
use light_samplers::light_bounds::{InfiniteBounds, LightExtent, LightId, SampledLight};
use light_samplers::{
    BvhLightSampler, ExhaustiveLightSampler, LightSampler, PowerLightSampler,
    ReferenceBvhLightSampler, UniformLightSampler,
};

use crate::support::lamp_over_floor::{floor, lamp};

const LAMP_1_W: LightId = LightId(0);
const SUN: LightId = LightId(1);
const LAMP_3_W: LightId = LightId(2);
const IDS: [LightId; 3] = [LAMP_1_W, SUN, LAMP_3_W];

/// The lamps are 2 above the floor and face it; the sun is above as well.
fn lights() -> [LightExtent; 3] {
    let sun = LightExtent::Infinite(InfiniteBounds::distant(2.0, Vec3::Z));
    [lamp(1.0), sun, lamp(3.0)]
}

/// Calls are made through a reference, which is a sampler as well.
fn check(name: &str, sampler: &impl LightSampler, at_floor: [f64; 3], emitters: [f64; 3]) {
    check_calls(name, sampler, at_floor, emitters);
}

fn check_calls(name: &str, sampler: impl LightSampler, at_floor: [f64; 3], emitters: [f64; 3]) {
    let floor = floor();
    check_choices(
        &format!("{name} at the floor"),
        at_floor,
        |id| sampler.pmf(&floor, id),
        |u| sampler.sample(&floor, u),
    );
    check_choices(
        &format!("{name} anywhere"),
        emitters,
        |id| sampler.pmf_emitter(id),
        |u| sampler.sample_emitter(u),
    );
    for count in [1, 4] {
        check_many(name, &sampler, count, at_floor);
    }
}

/// Probabilities are those expected, and evenly spread numbers choose each light so often, with an
/// even rest.
fn check_choices(
    name: &str,
    expected: [f64; 3],
    pmf: impl Fn(LightId) -> f32,
    sample: impl Fn(u64) -> Option<SampledLight>,
) {
    const DRAWS: u32 = 4000;
    let samples = (0..DRAWS).filter_map(|i| sample(stratum(i, DRAWS, 1 << 63)));
    check_samples(name, expected, pmf, &samples.collect::<Vec<_>>(), DRAWS);
}

/// The same for several choices at once.
fn check_many(name: &str, sampler: &impl LightSampler, count: u32, expected: [f64; 3]) {
    const CALLS: u32 = 1000;
    let name = format!("{name}, {count} choices");
    let here = sampler.at(&floor(), count);
    assert_eq!(here.count(), count, "{name}");
    let us = (0..CALLS).map(|i| stratum(i, CALLS, 1 << 63));
    let samples: Vec<SampledLight> = us.flat_map(|u| here.samples(u)).collect();
    check_samples(&name, expected, |id| here.pmf(id), &samples, CALLS * count);
}

fn check_samples(
    name: &str,
    expected: [f64; 3],
    pmf: impl Fn(LightId) -> f32,
    samples: &[SampledLight],
    draws: u32,
) {
    // What the tree's compact form of a power and of a distance leaves.
    const ROUNDING: f64 = 1e-2;
    for (id, expected) in IDS.into_iter().zip(expected) {
        let found = f64::from(pmf(id));
        assert!(
            (found - expected).abs() <= ROUNDING,
            "{name}: {id:?} has {found}, not {expected}"
        );
        let rests: Vec<f64> = samples
            .iter()
            .filter(|sample| sample.light == id)
            .map(|sample| {
                assert_eq!(sample.pmf, pmf(id), "{name}: {sample:?}");
                to_f64(sample.u)
            })
            .collect();
        let n = rests.len() as f64;
        let share = n / f64::from(draws);
        assert!((share - found).abs() < 2e-3, "{name}: {id:?} {share}");
        let moment = |power| rests.iter().map(|u| u.powi(power)).sum::<f64>() / n;
        let (mean, square) = (moment(1), moment(2));
        assert!(
            n == 0.0 || (mean - 0.5).abs() < 0.01 && (square - 1.0 / 3.0).abs() < 0.01,
            "{name}: {id:?} leaves rests of mean {mean}, and {square} for their squares"
        );
    }
}

#[test]
fn each_light_alike() {
    let sampler = UniformLightSampler::new(3);
    let third = [1.0 / 3.0; 3];
    check("uniform", &sampler, third, third);
}

#[test]
fn in_proportion_to_power() {
    let sampler = PowerLightSampler::new(&[1.0, 4.0, 3.0]).expect("powers");
    let shares = [0.125, 0.5, 0.375];
    check("power", &sampler, shares, shares);
}

/// The sun has one share, the lamps have one together.
#[test]
fn equal_shares_for_the_sun_and_the_rest() {
    let shares = [0.125, 0.5, 0.375];
    let exhaustive = ExhaustiveLightSampler::new(&lights()).expect("valid lights");
    check("exhaustive", &exhaustive, shares, shares);
    let tree = ReferenceBvhLightSampler::new(&lights()).expect("valid lights");
    check("reference", &tree, shares, shares);
}

/// A flat lamp that faces the floor straight has a radiant intensity of its power by pi: 4 W at a
/// distance of 2 give 1 / pi W/m².
#[test]
fn in_proportion_to_irradiance() {
    let lamps = 1.0 / core::f64::consts::PI;
    let at_floor = [0.25 * lamps, 2.0, 0.75 * lamps].map(|e| e / (lamps + 2.0));
    let emitters = [1.0 / 6.0, 1.0 / 3.0, 0.5];
    for options in [
        LightBvhOptions::default(),
        LightBvhOptions::FAST,
        LightBvhOptions::DYNAMIC,
    ] {
        let sampler = BvhLightSampler::with_options(&lights(), &options).expect("valid lights");
        check("tree", &sampler, at_floor, emitters);
    }
}

/// Without a sky all choices are of the tree.
#[test]
fn lamps_alone() {
    let [a, _, b] = lights();
    let dark = LightExtent::Infinite(InfiniteBounds::distant(0.0, Vec3::Z));
    let lights = [a, dark, b];
    let shares = [0.25, 0.0, 0.75];
    let tree = BvhLightSampler::new(&lights).expect("valid lights");
    check("tree", &tree, shares, shares);
    let reference = ReferenceBvhLightSampler::new(&lights).expect("valid lights");
    check("reference", &reference, shares, shares);
    let exhaustive = ExhaustiveLightSampler::new(&lights).expect("valid lights");
    check("exhaustive", &exhaustive, shares, shares);
}
