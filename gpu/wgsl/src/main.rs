//! Holds the shaders of light-gpu against the Rust crates: `light-gpu-check [QUERIES]`.
//!
//! Sets of four kinds and three sizes, each with so many queries (default: 2^20) by all kinds of
//! receivers in turn. The shader has to choose the same light for at least 99 % of them, to have
//! the probability 0 where the crates have it and nowhere else, and to find its own samples'
//! probabilities again, bit for bit. Then alias tables, octahedral codes and the equal-area map.

mod device;
mod maps;
mod query;
mod tally;

use std::process::ExitCode;

use light_bounds::LightExtent;
use light_bvh::LightBvh;
use light_gpu::{LIGHTS_WGSL, light_tree_rows};
use light_sets::{BenchSet, SetKind};

use crate::device::Device;
use crate::query::{Answer, Query};
use crate::tally::Tally;

/// The exit status that says that there is no device.
const NO_DEVICE: u8 = 77;

const KINDS: [SetKind; 4] = [
    SetKind::Uniform,
    SetKind::Clusters,
    SetKind::Spots,
    SetKind::Mixed,
];

fn main() -> ExitCode {
    let count = match std::env::args().nth(1).map_or(Ok(1 << 20), |n| n.parse()) {
        Ok(count) => count,
        Err(_) => {
            eprintln!("usage: light-gpu-check [QUERIES]");
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
    match check(&device, count) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// Prints a row a set; whether all of them keep what is promised.
fn check(device: &Device, count: u32) -> Result<bool, String> {
    println!("{count} queries a set on {}\n", device.name());
    println!("{}", Tally::HEAD);
    let mut all = true;
    for kind in KINDS {
        for n in [100, 10_000, 1_000_000] {
            let set = BenchSet::generate(kind, n, 1);
            let lights: Vec<LightExtent> = set.lights.iter().map(|l| l.bounds().into()).collect();
            let tree = LightBvh::build(&lights).map_err(|e| e.to_string())?;
            let tree = tree.view();
            let queries: Vec<Query> = (0..count).map(|i| Query::new(&set, i)).collect();
            let rows = light_tree_rows(&tree);
            let (answers, seconds) = device.run::<Answer>(("choose", 2), &rows, &queries)?;
            let mut tally = Tally::default();
            for (query, answer) in queries.iter().zip(&answers) {
                tally.add(&tree, query, answer);
            }
            println!("{}", tally.row(&format!("{} {n}", kind.name()), seconds));
            all &= tally.holds();
        }
    }
    let set = BenchSet::generate(SetKind::Uniform, 100, 1);
    let queries: Vec<Query> = (0..count).map(|i| Query::new(&set, i)).collect();
    all &= maps::check(device, &queries)?;
    println!("\n{}", if all { "all of it holds" } else { "FAILED" });
    Ok(all)
}
