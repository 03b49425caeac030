//! The costs of a tree of placed trees over one city.

use benches::city::{Place, city, context, placed_houses, places, receiver, streets};
use light_testkit::Rng;
use lights::bounds::LightSampleContext;
use lights::bvh::{InstancedLightBvh, Placement};
use lights::samplers::InstancedBvhLightSampler;

use super::columns::{Costs, Measured, Row};
use super::measure::{Effort, seconds_a_query};
use benches::thread_time::{median, seconds_a_call};

/// The most lights of a house.
const LIGHTS: usize = 10_000;

/// Receivers in the streets.
const RECEIVERS: usize = 4096;

/// The row of a city of so many lights, a power of ten: a house has as many lights as the city has
/// houses, but at most 10^4.
///
/// # Errors
/// More lights than ids.
pub(super) fn measure(lights: usize, effort: &Effort) -> Result<Row, String> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|e| format!("a thread for builds: {e}"))?;
    pool.install(|| {
        let in_house = 10_usize.pow(lights.ilog10() / 2).min(LIGHTS);
        let houses = lights / in_house;
        let (mut builds, mut refits) = (Vec::new(), Vec::new());
        for _ in 0..effort.rounds {
            builds.push(seconds_a_call(effort.window, || {
                core::hint::black_box(city(houses, in_house, &mut Rng::new(1)));
            }));
        }
        let (kinds, placed) = placed_houses(houses, in_house, &mut Rng::new(1));
        // A refit keeps the kinds.
        let moved: Vec<_> = places(houses, &mut Rng::new(2))
            .zip(placed.iter().map(Placement::prototype))
            .map(|(place, kind)| Place { kind, ..place }.placement())
            .collect();
        let tree = InstancedLightBvh::build(kinds, &placed).map_err(|e| e.to_string())?;
        let mut sampler = InstancedBvhLightSampler::new(tree, &[]).map_err(|e| e.to_string())?;
        let bytes = sampler.tree().bytes();
        let contexts = contexts(houses);
        let (mut samples, mut pmfs) = (Vec::new(), Vec::new());
        for round in 0..effort.rounds {
            let (sample, pmf) = seconds_a_query(&sampler, &contexts, effort.window, round);
            samples.push(sample);
            pmfs.extend(pmf);
        }
        let mut result = Ok(());
        for _ in 0..effort.rounds {
            refits.push(seconds_a_call(effort.window, || {
                if let Err(error) = sampler.refit(&moved) {
                    result = Err(format!("refit: {error}"));
                }
            }));
        }
        result?;
        let count = lights as f64;
        let nanoseconds = |seconds: &[f64]| Some(median(seconds)? * 1e9);
        let a_light = |seconds: &[f64]| Some(nanoseconds(seconds)? / count);
        Ok(Row {
            lights,
            sampler: Measured::Placed,
            costs: Costs {
                build: a_light(&builds),
                refit: a_light(&refits),
                sample: nanoseconds(&samples),
                pmf: nanoseconds(&pmfs),
                bytes: Some(bytes as f64 / count),
            },
        })
    })
}

fn contexts(houses: usize) -> Vec<LightSampleContext> {
    let mut rng = Rng::new(3);
    let across = streets(houses);
    (0..RECEIVERS)
        .map(|_| context(&receiver(&mut rng, across)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::columns::COLUMNS;
    use super::*;

    #[test]
    fn no_column_is_missing() {
        for lights in [100, 10_000] {
            let row = measure(lights, &Effort::QUICK).expect("a city");
            for (title, cost) in COLUMNS {
                let cost = cost(&row.costs);
                assert!(cost.is_some_and(|x| x > 0.0 && x.is_finite()), "{title}");
            }
        }
    }
}
