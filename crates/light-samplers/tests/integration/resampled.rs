//! Resampled choices: exact probabilities, unbiased sums with every sampler, nothing that has no
//! target.

use light_samplers::light_bounds::LightSampleContext;
use light_samplers::light_bounds::glam::Vec3;
use light_samplers::{BvhLightSampler, LightSampler, PowerLightSampler, UniformLightSampler};
use light_testkit::{Estimate, Rng, SamplerCase, chi_squared};

const DRAWS: u32 = 1 << 14;

/// Two stratified candidates of three lights: the middle one is split by the strata.
#[test]
fn kept_lights_have_the_exact_probabilities() {
    let targets = [1.0f32, 4.0, 2.0];
    // The position of one u decides about both: 0 with 1 for the first third of u, 0 with 2 for the
    // next, and 1 with 2 for the last.
    let mut expected = [0.0; 3];
    for [a, b] in [[0, 1], [0, 2], [1, 2]] {
        let sum = f64::from(targets[a] + targets[b]);
        for kept in [a, b] {
            expected[kept] += f64::from(targets[kept]) / sum / 3.0 * f64::from(DRAWS);
        }
    }
    let sampler = UniformLightSampler::new(3);
    let here = sampler.at(&LightSampleContext::medium(Vec3::ZERO), 2);
    let mut rng = Rng::new(81);
    let mut observed = [0; 3];
    for _ in 0..DRAWS {
        let u = rng.u64();
        let kept = here.resampled(u, |light| targets[light.index()], || rng.u64());
        assert_eq!(kept.count(), 2, "candidates");
        observed[kept.value().expect("a light").index()] += 1;
    }
    let test = chi_squared(&observed, &expected);
    assert!(test.passes(), "{observed:?}, expected {expected:?}");
}

/// The sum over lights is the mean, whatever the source and the number of candidates. What a light
/// gives is within a factor of 30 of its pmf, and its target within another of 10, so that means
/// have a normal distribution.
fn check_sums(name: &str, case: &SamplerCase, sampler: &impl LightSampler, rng: &mut Rng) {
    let step = usize::max(1, case.contexts.len() / 4);
    for ctx in case.contexts.iter().step_by(step) {
        for count in [1, 4, 16] {
            let here = sampler.at(ctx, count);
            let near = |x: f32, rng: &mut Rng, factor: f32| x * rng.log_range(1.0 / factor, factor);
            let gives: Vec<f32> = case.ids().map(|id| near(here.pmf(id), rng, 30.0)).collect();
            let targets: Vec<f32> = gives.iter().map(|&x| near(x, rng, 10.0)).collect();
            let exact: f64 = gives.iter().map(|&x| f64::from(x)).sum();
            let mean = Estimate::of(DRAWS, || {
                let u = rng.u64();
                let kept = here.resampled(u, |light| targets[light.index()], || rng.u64());
                assert_eq!(kept.count(), count, "{name}: candidates");
                let weight = kept.contribution_weight();
                kept.value().map_or(0.0, |light| {
                    assert!(kept.target() > 0.0 && weight > 0.0, "{name}: {kept:?}");
                    f64::from(gives[light.index()] * weight)
                })
            });
            assert!(
                mean.agrees_with(exact),
                "{name}, {count} candidates of {}: {mean:?}, exact {exact}",
                case.name
            );
        }
    }
}

#[test]
fn resampled_lights_add_up() {
    let mut rng = Rng::new(82);
    let case = SamplerCase::mixed(60, 8);
    check_sums(
        "uniform",
        &case,
        &UniformLightSampler::new(case.count()),
        &mut rng,
    );
    let power = PowerLightSampler::new(&case.powers()).expect("powers");
    check_sums("power", &case, &power, &mut rng);
    let bvh = BvhLightSampler::new(&case.extents()).expect("bounds");
    check_sums("bvh", &case, &bvh, &mut rng);
}

#[test]
fn a_light_without_a_target_is_never_kept() {
    let sampler = UniformLightSampler::new(5);
    let here = sampler.at(&LightSampleContext::medium(Vec3::ZERO), 5);
    let targets = [f32::NAN, 0.0, 1e-20, f32::INFINITY, -1.0];
    let mut rng = Rng::new(83);
    for _ in 0..100 {
        let u = rng.u64();
        let kept = here.resampled(u, |light| targets[light.index()], || rng.u64());
        assert_eq!(kept.value().map(|light| light.0), Some(2), "the only one");
        let none = here.resampled(u, |_| 0.0, || rng.u64());
        assert_eq!((none.value(), none.count()), (None, 5), "no target");
        assert_eq!(none.contribution_weight(), 0.0, "nothing");
    }
    let nothing = UniformLightSampler::new(0);
    let here = nothing.at(&LightSampleContext::medium(Vec3::ZERO), 3);
    let kept = here.resampled(0, |_| unreachable!("no light"), || 0);
    assert_eq!((kept.value(), kept.count()), (None, 3), "no lights");
}
