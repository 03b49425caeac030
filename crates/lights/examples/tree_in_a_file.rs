//! A tree of a million lights goes into a file, and comes back ready to answer.
//!
//! `cargo run --release -p lights --example tree_in_a_file [LIGHTS]`. A program that maps the file
//! into memory needs no copy: `StoredLightBvh::from_bytes` takes the bytes where they are.

use core::error::Error;
use std::path::Path;
use std::time::Instant;
use std::{env, fs};

use lights::bounds::{LightBounds, LightExtent, LightSampleContext, SampledLight};
use lights::bvh::LightBvh;
use lights::glam::Vec3;
use lights::math::Aabb;

/// Lamps along a spiral, that shine down.
fn lamps(count: u32) -> Vec<LightExtent> {
    let lamp = |k: u32| {
        let (t, share) = (k as f32 * 0.61803, k as f32 / count as f32);
        let place = Vec3::new(share * t.cos(), share * t.sin(), 0.1) * 100.0;
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_point(place),
            w: Vec3::NEG_Z,
            phi: 1.0,
            cos_theta_o: 1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        })
    };
    (0..count).map(lamp).collect()
}

/// Writes the tree of so many lights to `path`, reads it, and asks both for a light.
fn write_and_read(count: u32, path: &Path) -> Result<[Option<SampledLight>; 2], Box<dyn Error>> {
    let floor = LightSampleContext::surface(Vec3::new(20.0, 30.0, 0.0), Vec3::Z, Vec3::Z);
    let start = Instant::now();
    let tree = LightBvh::build(&lamps(count))?;
    println!("{count} lights: built in {:.1?}", start.elapsed());
    let start = Instant::now();
    fs::write(path, tree.to_bytes())?;
    println!("written in {:.1?}", start.elapsed());
    let start = Instant::now();
    let bytes = fs::read(path)?;
    println!("read in {:.1?}: {} bytes", start.elapsed(), bytes.len());
    let start = Instant::now();
    let again = LightBvh::from_bytes(&bytes)?;
    let choice = again.sample(&floor, 1 << 63);
    println!(
        "checked, and asked once, in {:.1?}: {choice:?}",
        start.elapsed()
    );
    Ok([tree.sample(&floor, 1 << 63), choice])
}

fn main() -> Result<(), Box<dyn Error>> {
    let count = env::args().nth(1).map_or(Ok(1_000_000), |n| n.parse())?;
    let path = env::temp_dir().join("lights-tree-in-a-file.bin");
    let choices = write_and_read(count, &path);
    fs::remove_file(&path)?;
    let [before, after] = choices?;
    assert_eq!(before, after, "the same light");
    Ok(())
}

#[test]
fn the_tree_that_comes_back_chooses_the_same_light() {
    let path = env::temp_dir().join(format!("lights-tree-{}.bin", std::process::id()));
    let choices = write_and_read(1000, &path);
    fs::remove_file(&path).expect("was written");
    let [before, after] = choices.expect("a tree");
    let before = before.expect("a light, for all lamps shine on the floor");
    assert_eq!(after, Some(before), "the same light");
    // The lamps are alike, so that the near ones have the largest probabilities.
    let LightExtent::Bounded(lamp) = lamps(1000)[before.light.index()] else {
        panic!("a lamp is bounded");
    };
    let apart = lamp.bounds.center().distance(Vec3::new(20.0, 30.0, 0.0));
    assert!(apart < 30.0 && before.pmf > 1e-3, "{apart}: {before:?}");
}
