//! Holds the shaders of light-gpu against the Rust crates: `light-gpu-check [QUERIES [SET]]`.
//!
//! Sets of four kinds and three sizes, and a tribune, each with so many queries (default: 2^20) by
//! all kinds of receivers in turn. The shader has to choose the same light for at least 99 % of
//! them, to have the probability 0 where the crates have it and nowhere else, and to find its own
//! samples' probabilities again, bit for bit. Then alias tables, octahedral codes and the
//! equal-area map.
//! Before all of it, what arrives from lights of each kind. With a part of the name of a set, such
//! as `clusters 10000`, only choices in the sets that have it; `light-gpu-check --sets` lists the
//! names.

mod arrivals;
mod bounds;
mod device;
mod maps;
mod query;
mod tally;

use std::process::ExitCode;

use light_bounds::{InfiniteBounds, LightExtent};
use light_gpu::{LIGHTS_WGSL, light_sampler_rows};
use light_math::DirectionCone;
use light_math::glam::Vec3;
use light_samplers::BvhLightSampler;
use light_sets::{BenchSet, Family, SetKind};

use crate::device::Device;
use crate::query::{Answer, Query};
use crate::tally::{Choices, Tally};

/// The exit status that says that there is no device.
const NO_DEVICE: u8 = 77;

const KINDS: [SetKind; 4] = [
    SetKind::Uniform,
    SetKind::Clusters,
    SetKind::Spots,
    SetKind::Mixed,
];

fn main() -> ExitCode {
    if std::env::args().nth(1).is_some_and(|word| word == "--sets") {
        names().iter().for_each(|name| println!("{name}"));
        return ExitCode::SUCCESS;
    }
    let count = match std::env::args().nth(1).map_or(Ok(1 << 20), |n| n.parse()) {
        Ok(count) => count,
        Err(_) => {
            eprintln!("usage: light-gpu-check [QUERIES [SET]]");
            return ExitCode::from(2);
        }
    };
    let shader = [LIGHTS_WGSL, include_str!("check.wgsl")].concat();
    let device = match Device::new(&shader) {
        Ok(device) => device,
        Err(why) => {
            eprintln!("no device: {why}");
            return ExitCode::from(NO_DEVICE);
        }
    };
    let part = std::env::args().nth(2);
    let checked = match part {
        None => check(&device, count),
        Some(part) => check_sets(&device, count, &part),
    };
    match checked {
        Ok(all) => {
            println!("\n{}", if all { "all of it holds" } else { "FAILED" });
            if all {
                ExitCode::SUCCESS
            } else {
                ExitCode::FAILURE
            }
        }
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// Prints a row a set; whether all of them keep what is promised.
fn check(device: &Device, count: u32) -> Result<bool, String> {
    println!("{count} queries a set on {}", device.name());
    let mut all = arrivals::check(device, count)?;
    all &= bounds::check(device, count, &KINDS)?;
    all &= check_sets(device, count, "")?;
    let set = BenchSet::generate(SetKind::Uniform, 100, 1);
    let queries: Vec<Query> = (0..count).map(|i| Query::new(&set, 100, i)).collect();
    Ok(all & maps::check(device, &queries)?)
}

/// Prints the rows of choices in the sets whose names have this `part`.
fn check_sets(device: &Device, count: u32, part: &str) -> Result<bool, String> {
    let sky = sky();
    let sets: Vec<_> = sets(&sky)
        .into_iter()
        .filter(|&(kind, n, infinite)| name(kind, n, infinite).contains(part))
        .collect();
    if sets.is_empty() {
        return Err(format!("no set has {part} in its name"));
    }
    println!("\n{}", Tally::HEAD);
    let mut all = true;
    for (kind, n, infinite) in sets {
        all &= check_set(device, kind, n, infinite, count)?;
    }
    Ok(all)
}

/// The sets in which choices are compared: their kinds, sizes, and lights at infinity.
fn sets(sky: &[LightExtent]) -> Vec<(SetKind, usize, &[LightExtent])> {
    let sizes = [100, 10_000, 1_000_000];
    let mut sets: Vec<(SetKind, usize, &[LightExtent])> = Vec::new();
    for kind in KINDS {
        sets.extend(sizes.map(|n| (kind, n, &[][..])));
    }
    // Slanted sheets.
    sets.push((SetKind::Place(Family::Tribune), 10_000, &[]));
    // Opposed beams, and lines of lights.
    sets.push((SetKind::Place(Family::WallLamps), 10_000, &[]));
    sets.push((SetKind::Place(Family::StreetLamps), 10_000, &[]));
    // Subtrees that are points.
    sets.push((SetKind::FarLamp, 100, &[]));
    sets.push((SetKind::FarLamp, 10_000, &[]));
    sets.push((SetKind::Uniform, 10_000, sky));
    sets
}

/// The names of all sets.
fn names() -> Vec<String> {
    let sky = sky();
    let sets = sets(&sky).into_iter();
    sets.map(|(kind, n, infinite)| name(kind, n, infinite))
        .collect()
}

fn name(kind: SetKind, n: usize, infinite: &[LightExtent]) -> String {
    let infinite = if infinite.is_empty() {
        ""
    } else {
        " and a sky"
    };
    format!("{} {n}{infinite}", kind.name())
}

/// Prints the row of a set of `n` lights with the lights at infinity `infinite`; whether it keeps
/// what is promised.
fn check_set(
    device: &Device,
    kind: SetKind,
    n: usize,
    infinite: &[LightExtent],
    count: u32,
) -> Result<bool, String> {
    let set = BenchSet::generate(kind, n, 1);
    let mut lights: Vec<LightExtent> = set.lights.iter().map(|l| l.bounds().into()).collect();
    lights.extend_from_slice(infinite);
    let sampler = BvhLightSampler::new(&lights).map_err(|e| e.to_string())?;
    let sampler = sampler.view();
    let rows = light_sampler_rows(&sampler).map_err(|e| e.to_string())?;
    let queries: Vec<Query> = (0..count)
        .map(|i| Query::new(&set, lights.len(), i))
        .collect();
    let name = name(kind, n, infinite);
    let mut all = true;
    for choices in [Choices::Single, Choices::OfFour] {
        let entry = choices.entry_point();
        let (answers, seconds) = device.run::<Answer>((entry, 2), &rows, &queries)?;
        let mut tally = Tally::default();
        for (query, answer) in queries.iter().zip(&answers) {
            tally.add(&sampler, choices, query, answer);
        }
        println!("{}", tally.row(&format!("{name}{choices}"), seconds));
        all &= tally.holds();
    }
    Ok(all)
}

/// A uniform sky, a sun, and a sky that is brighter on one side.
fn sky() -> [LightExtent; 3] {
    let sun = Vec3::new(0.36, 0.48, 0.8);
    let part = |fluence, mean, cone| {
        LightExtent::Infinite(InfiniteBounds {
            fluence,
            mean,
            cone,
        })
    };
    [
        part(0.2, Vec3::ZERO, DirectionCone::WHOLE_SPHERE),
        part(1.0, sun, DirectionCone::from_direction(sun)),
        part(
            0.5,
            0.4 * Vec3::X,
            DirectionCone {
                w: Vec3::X,
                cos_theta: 0.1,
            },
        ),
    ]
}
