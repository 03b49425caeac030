//! The lesson of the Cornell box: ten samples toward the lamp show less noise than a thousand over
//! the hemisphere, with the same mean; and a lamp that hangs below the ceiling lights it only when
//! it emits light on both sides.
//!
//! `cargo run --release -p light-render --example cornell_lesson` prints means and noise, and
//! writes `out/cornell-lesson-KIND-SPP.png` of the first three rows.

use std::fs;
use std::path::Path;

use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{AnyLightSampler, RenderSettings, SamplerKind, View, World, render};
use light_scene::glam::Vec3;
use light_scene::{BuiltinScene, EmissionSides, Image, Scene, write_png};

/// The side of the picture in pixels.
const SIZE: u32 = 128;

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let scene = BuiltinScene::CornellBox.load();
    let one_sided = hung(&scene, EmissionSides::Front);
    let two_sided = hung(&scene, EmissionSides::Both);
    println!(
        "{:<34} {:>5} {:>9} {:>9}",
        "direct light", "spp", "mean", "noise"
    );
    for (name, scene, estimator, spp) in [
        ("toward the lamp", &scene, Estimator::Light, 10),
        ("over the hemisphere", &scene, Estimator::Bsdf, 10),
        ("over the hemisphere", &scene, Estimator::Bsdf, 1000),
        ("both, weighted", &scene, Estimator::Mis, 10),
        (
            "a lamp 20 cm lower, one-sided",
            &one_sided,
            Estimator::Light,
            10,
        ),
        (
            "a lamp 20 cm lower, two-sided",
            &two_sided,
            Estimator::Light,
            10,
        ),
    ] {
        let (a, b) = (
            picture(scene, estimator, spp, 1)?,
            picture(scene, estimator, spp, 2)?,
        );
        println!(
            "{name:<34} {spp:>5} {:>9.4} {:>9.4}",
            mean(&a),
            noise(&a, &b)
        );
        match name {
            "toward the lamp" => show("lamp", spp, &a)?,
            "over the hemisphere" => show("hemisphere", spp, &a)?,
            _ => {}
        }
    }
    Ok(())
}

/// Writes a picture.
fn show(kind: &str, spp: u32, pixels: &[Vec3]) -> Result<(), Box<dyn core::error::Error>> {
    let pixels = pixels.iter().map(|&l| (l * EXPOSURE).min(Vec3::ONE));
    let image = Image::new(SIZE, SIZE, pixels.collect())?;
    fs::create_dir_all("out")?;
    let path = format!("out/cornell-lesson-{kind}-{spp}.png");
    Ok(write_png(Path::new(&path), &image)?)
}

/// Factor of radiances; 1 is white then.
const EXPOSURE: f32 = 8.0;

/// The scene with its lamp 200 mm below the ceiling, in whose plane it lies otherwise, shining on
/// the given `sides`.
fn hung(scene: &Scene, sides: EmissionSides) -> Scene {
    let mut scene = scene.clone();
    for mesh in &mut scene.meshes {
        if let Some(emission) = &mut scene.materials[mesh.material.0 as usize].emission {
            emission.sides = sides;
            mesh.positions.iter_mut().for_each(|p| p.y -= 200.0);
        }
    }
    scene
}

/// Direct light alone, the lamp itself left out.
fn picture(
    scene: &Scene,
    estimator: Estimator,
    spp: u32,
    seed: u32,
) -> Result<Vec<Vec3>, Box<dyn core::error::Error>> {
    let view = View::new(&scene.camera_or_default(), SIZE, SIZE)?;
    let world = World::new(scene.clone())?;
    let sampler = AnyLightSampler::new(SamplerKind::Bvh, world.lights())?;
    let of_depth = |max_depth, spp| {
        let settings = RenderSettings {
            samples: 0..spp,
            time_limit: None,
            seed,
            path: PathSettings {
                max_depth,
                estimator,
                light_samples: PathSettings::DEFAULT_LIGHT_SAMPLES,
                integrator: Integrator::Path,
            },
        };
        render(&world, &view, &sampler, &settings, |_| ())
            .film
            .develop()
    };
    let seen = of_depth(1, spp);
    let lit = of_depth(2, spp);
    Ok(lit
        .iter()
        .zip(&seen)
        .map(|(&lit, &seen)| lit - seen)
        .collect())
}

/// The mean of all pixels and channels.
fn mean(pixels: &[Vec3]) -> f32 {
    pixels.iter().map(|p| p.element_sum() / 3.0).sum::<f32>() / pixels.len() as f32
}

/// The standard deviation of a pixel, from two pictures that differ in their random numbers alone.
fn noise(a: &[Vec3], b: &[Vec3]) -> f32 {
    let squares = a
        .iter()
        .zip(b)
        .map(|(&a, &b)| (a - b).length_squared() / 3.0);
    (squares.sum::<f32>() / (2 * a.len()) as f32).sqrt()
}
