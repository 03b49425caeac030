//! Light samplers measured side by side on a light set: exact variance, time, memory, and the laws
//! they must obey.
//!
//! The estimator is that of one unoccluded shading point: the contribution of the chosen light over
//! its probability. Its variance is summed over all lights, not sampled, so that a rare large term
//! cannot hide. [`scene_variance`] does the same for the receivers that a camera sees, with true
//! visibility; [`PictureBench`] times whole pictures.

mod build_time;
mod candidate;
mod contributions;
mod cpu_time;
mod ground_truth;
mod laws;
mod measure;
mod measurement;
mod occluders;
mod options;
mod pictures;
mod pixel_variance;
mod query;
mod receiver;
mod refits;
mod repetition;
mod row;
mod scene;
mod scene_query;
mod scene_receiver;
mod scene_variance;
mod statistics;
mod surface_points;
mod timing;
mod unlit_pixels;
mod variance;
mod variance_split;

pub use cpu_time::CpuTimer;
pub use ground_truth::GroundTruth;
pub use laws::Laws;
pub use measurement::Measurement;
pub use options::BenchOptions;
pub use pictures::{PictureBench, RelativeError, TimedPicture};
pub use pixel_variance::{PixelVariance, pixel_variance};
pub use receiver::BenchReceiverKind;
pub use refits::{RefitRow, refits};
pub use row::BenchRow;
pub use scene::{SceneBenchOptions, bench_scene};
pub use scene_receiver::Shadows;
pub use scene_variance::{ChoiceKind, RelativeVariance, SceneVariance, scene_variance};
pub use timing::QueryTime;
pub use variance::{Ceiling, Variance};
pub use variance_split::{LightMoments, VarianceSplit};

use light_sets::BenchSet;

use crate::AnyLightSamplerError;
use candidate::Candidate;
use measure::Plan;
use query::Query;

/// One row for each sampler, all measured in this run and in turns, so that their ratios are valid
/// on a busy machine.
///
/// # Errors
/// The first light that a sampler refuses.
///
/// # Panics
/// If the system refuses to start the threads.
pub fn bench(
    name: &str,
    set: &BenchSet,
    options: &BenchOptions,
) -> Result<Vec<BenchRow>, AnyLightSamplerError> {
    let (extents, powers) = (set.extents(), set.powers());
    let plan = Plan {
        set: name,
        measurement: &options.measurement,
        points: options.points_of(set),
        extents: &extents,
    };
    plan.measure(&Query::new(set, options), |kind| {
        Candidate::new(kind, &extents, &powers)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SamplerKind;
    use core::f64::consts::PI;
    use light_sets::{SetKind, SetLight, SetPoint};
    use lights::glam::Vec3;

    fn options(k: u32) -> BenchOptions {
        of(SamplerKind::Uniform, k)
    }

    fn of(sampler: SamplerKind, k: u32) -> BenchOptions {
        BenchOptions {
            measurement: Measurement {
                samplers: vec![sampler],
                k,
                var_points: Some(16),
                ..Measurement::default()
            },
            ..BenchOptions::default()
        }
    }

    #[test]
    fn uniform_sampling_loses_nothing_and_its_pmf_adds_up() {
        let set = BenchSet::generate(SetKind::Mixed, 50, 1);
        let rows = bench("mixed", &set, &options(1)).expect("valid lights");
        let row = &rows[0];
        assert_eq!(row.variance.lost_energy, 0.0, "every light can be picked");
        assert_eq!(row.laws.pmf_mismatch, 0.0, "same bits");
        assert!(row.laws.pmf_sum_max_error < 1e-6, "a distribution");
        assert!(row.variance.mean > 1.0, "as noisy as uniform sampling is");
    }

    /// A spot of a narrow cone and both sides of a triangle: bounds give other powers.
    #[test]
    fn choices_by_power_go_by_what_is_emitted() {
        let lights = vec![
            SetLight::Triangle {
                vertices: [Vec3::Z, Vec3::Z + Vec3::Y, Vec3::Z + Vec3::X],
                radiance: 1.0,
                two_sided: true,
            },
            SetLight::Spot {
                p: Vec3::Z,
                target: Vec3::ZERO,
                intensity: 1.0,
                cone_deg: 10.0,
                delta_deg: 0.0,
            },
        ];
        let at = SetPoint {
            p: Vec3::ZERO,
            n: Vec3::Z,
        };
        let f = [0, 1].map(|i: usize| lights[i].contribution(&at));
        let powers = [PI, 2.0 * PI * (1.0 - 10f64.to_radians().cos())];
        let all = powers[0] + powers[1];
        let moment: f64 = (0..2).map(|i| f[i] * f[i] * all / powers[i]).sum();
        let expected = moment / (f[0] + f[1]).powi(2) - 1.0;
        let points = vec![at];
        let set = BenchSet { lights, points };
        let found = bench("two", &set, &of(SamplerKind::Power, 1)).expect("valid lights");
        let found = found[0].variance.mean;
        assert!((found / expected - 1.0).abs() < 1e-3, "{found}, {expected}");
    }

    #[test]
    fn repeated_calls_agree_with_the_exact_variance() {
        let set = BenchSet::generate(SetKind::Uniform, 10, 1);
        let exact = &bench("uniform", &set, &options(1)).expect("valid lights")[0];
        let repeated = &bench("uniform", &set, &options(2)).expect("valid lights")[0];
        // Two stratified samples are at most as noisy as two independent ones, up to the noise of
        // the estimate.
        assert!(
            repeated.variance.mean < exact.variance.mean * 1.5,
            "{} against {}",
            repeated.variance.mean,
            exact.variance.mean
        );
        assert!(repeated.variance.mean > 0.0, "but noisy");
    }

    #[test]
    fn occluders_and_areas_show_in_the_split() {
        let set = BenchSet::generate(SetKind::Uniform, 50, 1);
        let split = |occluders, ground_truth| {
            let options = BenchOptions {
                occluders,
                ground_truth,
                ..options(1)
            };
            let row = &bench("uniform", &set, &options).expect("valid lights")[0];
            row.variance.ceiling.expect("one sample a call")
        };
        let open = split(0, GroundTruth::Centroid);
        assert_eq!(open.within, 0.0, "lights are points");
        assert!(open.best < 1e-12, "and each is known: {open:?}");
        assert_eq!(open.arriving, 1.0, "all seen");
        let behind = split(64, GroundTruth::Centroid);
        assert!(behind.arriving < 0.95, "{behind:?}");
        let areas = split(64, GroundTruth::Area);
        assert!(
            areas.within > 0.0 && areas.best > 0.0,
            "penumbrae: {areas:?}"
        );
        let total = bench("uniform", &set, &options(1)).expect("valid lights")[0]
            .variance
            .mean;
        assert!(areas.best < total, "better than by chance: {areas:?}");
    }

    /// An invalid light gives an error, not a panic.
    #[test]
    fn a_light_that_is_refused_is_named() {
        let mut set = BenchSet::generate(SetKind::Uniform, 10, 1);
        set.lights[7] = set.lights[7].moved(Vec3::splat(1e38));
        let options = of(SamplerKind::Bvh, 1);
        let error = bench("uniform", &set, &options).expect_err("too far");
        assert!(error.to_string().starts_with("light 7: "), "{error}");
        let error = refits("uniform", &set, &options, 1).expect_err("too far");
        assert!(error.to_string().starts_with("light 7: "), "{error}");
    }
}
