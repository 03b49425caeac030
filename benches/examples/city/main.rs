//! A city whose houses are placed and stored once: a billion lights, and with a million the same
//! lights in one flat tree for comparison.
//!
//! `city` measures both; `city variance SEED...` is the comparison alone, of arrangements made from
//! these seeds; `city crossing` compares both trees as the lights grow; `city samples` and `city
//! flat` only take samples, for callgrind; `city scene HOUSES LIGHTS FILE` writes a city of houses of
//! so many lights as a scene of pbrt.

mod crossing;
mod million;
mod scene;

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use benches::city::{city, context, extents, house, on_grid, receiver, streets};
use benches::peak_memory::peak_memory;
use benches::thread_time::{median, seconds_a_call};
use light_testkit::Rng;
use lights::bvh::{InstancedLightBvh, LightBvh};

/// Houses of the billion, each of [`LIGHTS`].
const HOUSES: usize = 100_000;

/// Lights of a house.
const LIGHTS: usize = 10_000;

/// Calls of one turn of a timing.
const CALLS: u32 = 20_000;

const USAGE: &str =
    "usage: city [variance SEED... | crossing | samples | flat | scene HOUSES LIGHTS FILE]";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match *words {
        [] => {
            billion_lights();
            million::compare(&[4, 5]);
        }
        ["variance", ref seeds @ ..] => {
            let seeds = seeds.iter().map(|seed| seed.parse());
            million::compare(&seeds.collect::<Result<Vec<_>, _>>()?);
        }
        ["crossing"] => crossing::compare(),
        ["samples"] => ask(&billion(), streets(HOUSES)),
        ["flat"] => ask_flat(&flat_million()),
        ["scene", houses, lights, file] => {
            scene::write(Path::new(file), houses.parse()?, lights.parse()?)?;
        }
        _ => return Err(USAGE.into()),
    }
    Ok(())
}

fn billion() -> InstancedLightBvh {
    city(HOUSES, LIGHTS, &mut Rng::new(1))
}

// Not inlined, so that callgrind can count it alone.
#[inline(never)]
fn ask(tree: &InstancedLightBvh, streets: usize) {
    let mut rng = Rng::new(3);
    for _ in 0..CALLS {
        let ctx = context(&receiver(&mut rng, streets));
        black_box(tree.sample(&ctx, rng.u64()));
    }
}

#[inline(never)]
fn ask_flat(tree: &LightBvh) {
    let mut rng = Rng::new(3);
    for _ in 0..CALLS {
        let ctx = context(&receiver(&mut rng, 10));
        black_box(tree.sample(&ctx, rng.u64()));
    }
}

/// 100 houses of 10^4 lights.
fn flat_million() -> LightBvh {
    let mut rng = Rng::new(1);
    let mut lights = Vec::new();
    for i in 0..100 {
        let by = on_grid(i, 10);
        let house = house(LIGHTS, &mut rng);
        lights.extend(house.iter().map(|light| light.moved(by)));
    }
    LightBvh::build(&extents(&lights)).expect("valid lights")
}

fn billion_lights() {
    let start = Instant::now();
    let tree = billion();
    println!(
        "{} lights, built in {:?}",
        tree.light_count(),
        start.elapsed()
    );
    println!("{} MB of tree", tree.bytes() / 1_000_000);
    println!("{} at most in memory", peak_memory());
    let flat = flat_million();
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..15 {
        theirs.push(seconds_a_call(0.1, || ask_flat(&flat)));
        ours.push(seconds_a_call(0.1, || ask(&tree, streets(HOUSES))));
    }
    let nanoseconds =
        |seconds: &[f64]| median(seconds).unwrap_or_default() * 1e9 / f64::from(CALLS);
    let [ours, theirs] = [ours, theirs].map(|seconds| nanoseconds(&seconds));
    println!(
        "ns of processor time a sample, with what makes its receiver: {ours:.0}, of a flat tree of \
         a million {theirs:.0} ({:.2} x)",
        ours / theirs
    );
}
