use core::fmt;

use light_sets::BenchSet;
use lights::glam::Vec3;
use lights::math::Aabb;
use lights::math::fraction::to_f64;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::{Value, json};

use super::BenchOptions;
use super::candidate::Candidate;
use super::query::Query;
use super::row::known;
use super::variance::{self, Variance};
use crate::{AnyLightSamplerError, SamplerKind};

/// Displacement of lights in the first step, relative to the mean distance of neighbours; each step
/// doubles it.
const FIRST: f32 = 1.0 / 64.0;

/// The quality of a refitted hierarchy, compared with one built for the same lights.
#[derive(Clone, Debug)]
pub struct RefitRow {
    /// Name of the set.
    pub set: String,
    /// Lights of the set.
    pub n_lights: usize,
    /// The hierarchy.
    pub sampler: SamplerKind,
    /// Displacement of each light, in mean distances of neighbours.
    pub moved: f32,
    /// Degradation of the refitted hierarchy, relative to the first build.
    pub degradation: f64,
    /// Variance with the refitted hierarchy.
    pub refitted: Variance,
    /// Variance with a new build.
    pub rebuilt: Variance,
}

/// A row for each hierarchy and step: each light moves along a line of its own, twice
/// as far in each step; the points stay. Samplers without refits have no rows.
///
/// # Errors
/// The first light that a sampler refuses, at the start or on its way.
pub fn refits(
    name: &str,
    set: &BenchSet,
    options: &BenchOptions,
    steps: u32,
) -> Result<Vec<RefitRow>, AnyLightSamplerError> {
    let mut rng = Pcg64Mcg::seed_from_u64(0xD21F);
    let distance = mean_distance(set);
    let ways: Vec<Vec3> = set
        .lights
        .iter()
        .map(|_| direction(&mut rng) * distance)
        .collect();
    let points = options.points_of(set);
    let mut rows = Vec::new();
    for &sampler in &options.measurement.samplers {
        let mut following = Candidate::new(sampler, &set.extents(), &set.powers())?;
        let Some(at_first) = following.degradation() else {
            continue;
        };
        for moved in (0..=steps).map(distance_after) {
            let lights = set.lights.iter().zip(&ways);
            let set = BenchSet {
                lights: lights
                    .map(|(light, &way)| light.moved(way * moved))
                    .collect(),
                points: set.points.clone(),
            };
            let query = Query::new(&set, options);
            let variance = |candidate: &Candidate| variance::exact(candidate, &query, points);
            following.refit(&set.extents())?;
            rows.push(RefitRow {
                set: name.to_owned(),
                n_lights: set.lights.len(),
                sampler,
                moved,
                degradation: following.degradation().map_or(0.0, |now| now / at_first),
                refitted: variance(&following),
                rebuilt: variance(&Candidate::new(sampler, &set.extents(), &set.powers())?),
            });
        }
    }
    Ok(rows)
}

/// In mean distances of neighbours; 0 before the first step.
fn distance_after(step: u32) -> f32 {
    match step.checked_sub(1) {
        Some(doublings) => FIRST * (1_u64 << doublings.min(63)) as f32,
        None => 0.0,
    }
}

/// The side of the cube that a light has for itself.
#[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
fn mean_distance(set: &BenchSet) -> f32 {
    let boxes = set.lights.iter().map(|light| light.bounds().bounds);
    let size = boxes.fold(Aabb::EMPTY, Aabb::union).diagonal();
    let volume = size.as_dvec3().element_product();
    (volume / set.lights.len().max(1) as f64).cbrt() as f32
}

#[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
fn direction(rng: &mut Pcg64Mcg) -> Vec3 {
    let mut within = || 2.0 * to_f64(rng.next_u64()) as f32 - 1.0;
    loop {
        let v = Vec3::new(within(), within(), within());
        if (0.01..=1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

impl RefitRow {
    /// The title line of a table of rows.
    #[must_use]
    pub fn header() -> String {
        format!(
            "{:<11} {:>8} {:<14} {:>8} {:>9} {:>9} {:>9} {:>11} {:>11}",
            "set",
            "lights",
            "sampler",
            "moved",
            "degradation",
            "V refit",
            "V 99 %",
            "V new build",
            "V 99 %"
        )
    }

    /// The row as one JSON object.
    #[must_use]
    pub fn json(&self) -> Value {
        json!({
            "set": self.set,
            "n_lights": self.n_lights,
            "sampler": self.sampler.name(),
            "moved": self.moved,
            "degradation_ratio": self.degradation,
            "v_mean": self.refitted.mean,
            "v_median": self.refitted.median,
            "v_p99": self.refitted.p99,
            "v_mean_rebuilt": self.rebuilt.mean,
            "v_median_rebuilt": self.rebuilt.median,
            "v_p99_rebuilt": self.rebuilt.p99,
            "lost_energy": self.refitted.lost_energy,
        })
    }
}

impl fmt::Display for RefitRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mean = |v: &Variance| known(v.mean, format_args!("{:.3}", v.mean));
        let p99 = |v: &Variance| known(v.p99, format_args!("{:.2}", v.p99));
        write!(
            f,
            "{:<11} {:>8} {:<14} {:>8.4} {:>9.3} {:>9} {:>9} {:>11} {:>11}",
            self.set,
            self.n_lights,
            self.sampler.name(),
            self.moved,
            self.degradation,
            mean(&self.refitted),
            p99(&self.refitted),
            mean(&self.rebuilt),
            p99(&self.rebuilt),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Measurement;
    use light_sets::SetKind;

    #[test]
    fn a_hierarchy_that_follows_loses_nothing_but_grows_loose() {
        let set = BenchSet::generate(SetKind::Uniform, 500, 1);
        let options = BenchOptions {
            measurement: Measurement {
                samplers: vec![SamplerKind::Uniform, SamplerKind::Bvh],
                var_points: Some(16),
                ..Measurement::default()
            },
            ..BenchOptions::default()
        };
        let rows = refits("uniform", &set, &options, 7).expect("valid lights");
        assert_eq!(rows.len(), 8, "uniform sampling follows nothing");
        let (first, last) = (&rows[0], &rows[7]);
        assert_eq!(first.moved, 0.0, "where they were");
        assert!(
            (first.degradation - 1.0).abs() < 1e-6,
            "{}",
            first.degradation
        );
        assert_eq!(last.moved, 1.0, "a whole distance");
        assert!(last.degradation > 1.1, "{}", last.degradation);
        assert!(
            rows.iter().all(|row| row.refitted.lost_energy == 0.0),
            "no light is lost on the way"
        );
    }
}
