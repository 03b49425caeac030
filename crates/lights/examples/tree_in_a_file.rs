//! A tree of a million lights goes into a file, and comes back ready to answer.
//!
//! `cargo run --release -p lights --example tree_in_a_file [LIGHTS]` prints how long that takes,
//! and writes `out/tree_in_a_file.png`: the floor below the lamps, by the tree that came back. A
//! program that maps the file into memory needs no copy: `StoredLightBvh::from_bytes` takes the
//! bytes where they are.

use core::error::Error;
use core::f32::consts::FRAC_1_PI;
use std::path::Path;
use std::time::Instant;
use std::{env, fs};

use lights::bounds::{LightBounds, LightExtent, LightSampleContext, SampledLight};
use lights::bvh::{CutDetail, LightBvh};
use lights::glam::{Vec2, Vec3};
use lights::math::{Aabb, fraction};
use lights::media::LatinHypercube;

mod picture;
type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// Half the side of the floor that is drawn.
const HALF: f32 = 110.0;

/// Where lamp `k` of so many hangs: along a spiral, more and more apart.
fn place(k: u32, count: u32) -> Vec3 {
    let (t, share) = (k as f32 * 0.61803, k as f32 / count as f32);
    Vec3::new(share * t.cos(), share * t.sin(), 0.1 + 0.1 * share) * 100.0
}

/// The lamps: each has the power 1 and emits downward, as the cosine.
fn lamps(count: u32) -> Vec<LightExtent> {
    let lamp = |k| {
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_point(place(k, count)),
            w: Vec3::NEG_Z,
            phi: 1.0,
            cos_theta_o: 1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        })
    };
    (0..count).map(lamp).collect()
}

/// Irradiance of the floor at `p` by the lamp at `place`.
fn irradiance(p: Vec3, place: Vec3) -> f32 {
    let to_lamp = place - p;
    // The cosines at lamp and floor are the same.
    FRAC_1_PI * (to_lamp.z / to_lamp.length_squared()).powi(2)
}

/// The mean of `choices` of one of `count` lamps.
fn estimate(tree: &LightBvh, count: u32, p: Vec3, choices: u32, u: u64) -> f32 {
    let cut = tree.view().cut(&floor(p), CutDetail::default());
    let from = |choice: SampledLight| irradiance(p, place(choice.light.0, count)) / choice.pmf;
    let all = (0..choices).filter_map(|i| cut.sample(fraction::stratum(i, choices, u)));
    all.map(from).sum::<f32>() / choices as f32
}

fn floor(p: Vec3) -> LightSampleContext {
    LightSampleContext::surface(p, Vec3::Z, Vec3::Z)
}

/// Writes a tree to `path`, and reads it again.
fn write_and_read(tree: &LightBvh, path: &Path) -> Result<LightBvh> {
    let start = Instant::now();
    fs::write(path, tree.to_bytes())?;
    println!("written in {:.1?}", start.elapsed());
    let start = Instant::now();
    let bytes = fs::read(path);
    fs::remove_file(path)?;
    let bytes = bytes?;
    println!("read in {:.1?}: {} bytes", start.elapsed(), bytes.len());
    let start = Instant::now();
    let again = LightBvh::from_bytes(&bytes)?;
    let choice = again.sample(&floor(Vec3::ZERO), 1 << 63);
    println!(
        "checked, and asked once, in {:.1?}: {choice:?}",
        start.elapsed()
    );
    Ok(again)
}

fn main() -> Result<()> {
    let count = env::args().nth(1).map_or(Ok(1_000_000), |n| n.parse())?;
    let start = Instant::now();
    let tree = LightBvh::build(&lamps(count))?;
    println!("{count} lights: built in {:.1?}", start.elapsed());
    let tree = write_and_read(&tree, &env::temp_dir().join("lights-tree-in-a-file.bin"))?;

    // White is five times the irradiance of a floor that all power reaches evenly.
    let exposure = 0.2 * (2.0 * HALF).powi(2) / count as f32;
    picture::save("tree_in_a_file", [256, 256], |x, y| {
        let at = (Vec2::new(x as f32, y as f32) - 127.5) / 128.0 * HALF;
        let [u] = LatinHypercube::new(256 * 256, 7).point(y * 256 + x);
        Vec3::splat(exposure * estimate(&tree, count, at.extend(0.0), 8, u))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_that_comes_back_chooses_the_same_lights() -> Result<()> {
        let count = 1000;
        let tree = LightBvh::build(&lamps(count))?;
        let path = env::temp_dir().join(format!("lights-tree-{}.bin", std::process::id()));
        let again = write_and_read(&tree, &path)?;
        for p in [Vec3::new(20.0, 30.0, 0.0), Vec3::new(-60.0, 5.0, 0.0)] {
            for i in 0..64 {
                let u = fraction::stratum(i, 64, 1 << 63);
                let before = tree.sample(&floor(p), u);
                assert!(before.is_some(), "all lamps emit toward the floor");
                assert_eq!(again.sample(&floor(p), u), before, "at {p}");
            }
            let exact: f32 = (0..count).map(|k| irradiance(p, place(k, count))).sum();
            let mean = estimate(&again, count, p, 1 << 14, 1 << 63);
            assert!((mean / exact - 1.0).abs() < 0.01, "{mean}, not {exact}");
        }
        Ok(())
    }
}
