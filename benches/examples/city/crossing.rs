//! From how many placed lights on a tree of placed trees is the better choice.

use std::hint::black_box;
use std::time::Instant;

use benches::city::{KINDS, city, context, extents, house, places, receiver, streets};
use benches::exact_variance::{flat_variance, placed_variance, summary};
use benches::thread_time::{median, seconds_a_call};
use light_testkit::Rng;
use light_testkit::light_sets::SetLight;
use lights::bounds::{LightExtent, LightSampleContext};
use lights::bvh::LightBvh;

/// Calls of one turn of a timing.
const CALLS: usize = 4096;

/// Cities of equally many houses and lights a house, about.
const CITIES: [(usize, usize); 8] = [
    (100, 10),
    (100, 100),
    (400, 100),
    (1024, 100),
    (1024, 300),
    (1024, 1000),
    (2500, 1000),
    (4096, 2500),
];

/// Prints a row of a table for each city.
pub(crate) fn compare() {
    println!(
        "| houses, lights of each | flat: build ms | ns sample | V | bytes | placed: build ms | \
         ns sample | V | bytes |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
    );
    for (houses, lights) in CITIES {
        row(houses, lights);
    }
}

fn row(houses: usize, lights: usize) {
    let placed_build = Instant::now();
    let placed = city(houses, lights, &mut Rng::new(1));
    let placed_build = placed_build.elapsed().as_secs_f64() * 1e3;
    let all = all_lights(houses, lights);
    let extents: Vec<LightExtent> = extents(&all);
    let flat_build = Instant::now();
    let flat = LightBvh::build(&extents).expect("valid lights");
    let flat_build = flat_build.elapsed().as_secs_f64() * 1e3;
    let mut rng = Rng::new(3);
    let points: Vec<_> = (0..CALLS)
        .map(|_| receiver(&mut rng, streets(houses)))
        .collect();
    let asked: Vec<(LightSampleContext, u64)> = points
        .iter()
        .map(|point| (context(point), rng.u64()))
        .collect();
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..9 {
        ours.push(timed(&asked, |ctx, u| placed.sample(ctx, u).is_some()));
        theirs.push(timed(&asked, |ctx, u| flat.view().sample(ctx, u).is_some()));
    }
    let looked_at = (40_000_000 / all.len()).clamp(8, 512);
    let (mut v_placed, mut v_flat) = (Vec::new(), Vec::new());
    for point in &points[..looked_at] {
        v_placed.extend(placed_variance(&all, &placed, point));
        v_flat.extend(flat_variance(&all, &flat, point));
    }
    println!(
        "| {houses}, {lights} | {flat_build:.1} | {:.0} | {} | {} | {placed_build:.1} | {:.0} | {} \
         | {} |",
        median(&theirs).unwrap_or_default(),
        summary(v_flat),
        flat.bytes(),
        median(&ours).unwrap_or_default(),
        summary(v_placed),
        placed.bytes()
    );
}

/// The lights of a city one by one, in the order in which it is asked for them.
fn all_lights(houses: usize, lights: usize) -> Vec<SetLight> {
    let mut rng = Rng::new(1);
    let kinds: Vec<Vec<SetLight>> = (0..KINDS).map(|_| house(lights, &mut rng)).collect();
    let mut all = Vec::with_capacity(houses * lights);
    for place in places(houses, &mut rng) {
        let to_city = place.transform();
        let moved = kinds[place.kind as usize].iter().map(|light| match *light {
            SetLight::Triangle {
                vertices,
                radiance,
                two_sided,
            } => SetLight::Triangle {
                vertices: vertices.map(|p| to_city.transform_point3(p)),
                radiance,
                two_sided,
            },
            other => other,
        });
        all.extend(moved);
    }
    all
}

fn timed(
    asked: &[(LightSampleContext, u64)],
    sample: impl Fn(&LightSampleContext, u64) -> bool,
) -> f64 {
    let seconds = seconds_a_call(0.1, || {
        for (ctx, u) in asked {
            black_box(sample(ctx, *u));
        }
    });
    seconds * 1e9 / asked.len() as f64
}
