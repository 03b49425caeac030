//! The same scenes by independent renderers: the pictures of `testdata/foreign` are Mitsuba's and
//! Cycles'.

use core::num::NonZeroU32;
use std::fs;
use std::path::{Path, PathBuf};

use light_render::{Comparison, SamplerKind};
use light_scene::glam::{Affine3A, DVec3, Vec3};
use light_scene::{Scene, read_image, read_pbrt};

use crate::support::Shot;

/// Pixels a side of every picture, and of the blocks whose means are compared.
const SIZE: u32 = 48;
const BLOCK: u32 = 8;
/// Independent pictures of ours, from which their noise is known.
const RUNS: u32 = 16;
const SPP: u32 = 16;
/// As the program's default.
const LIGHT_SAMPLES: NonZeroU32 = NonZeroU32::new(16).expect("not zero");

/// What the table of the references says of one.
struct Reference {
    depth: u32,
    /// Standard error of the mean of the picture.
    error: DVec3,
    /// Mean squared error over its squared pixels, as [`Comparison::rel_mse`].
    rel_mse: f64,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("testdata/foreign")
}

fn reference(name: &str) -> Reference {
    let table = fs::read_to_string(folder().join("references.tsv")).expect("a table");
    let row = table.lines().find_map(|line| {
        let (scene, figures) = line.split_once('\t')?;
        (scene == name).then(|| figures.to_owned())
    });
    let row = row.expect("a row of the scene");
    let figures: Vec<f64> = row
        .split('\t')
        .map(|figure| figure.parse().expect("a number"))
        .collect();
    let [depth, _, _, _, _, r, g, b, rel_mse] = figures[..] else {
        panic!("{row} has other columns");
    };
    Reference {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small whole number"
        )]
        depth: depth as u32,
        error: DVec3::new(r, g, b),
        rel_mse,
    }
}

fn image(name: &str) -> Vec<Vec3> {
    let file = read_image(&folder().join(name)).expect("an image");
    file.image.into_texels()
}

/// Means of squares of `side` by `side` pixels.
fn means(pixels: &[Vec3], side: u32) -> Vec<DVec3> {
    let across = SIZE / side;
    let mut sums = vec![DVec3::ZERO; (across * across) as usize];
    for (i, pixel) in (0..).zip(pixels) {
        let (x, y) = (i % SIZE / side, i / SIZE / side);
        sums[(y * across + x) as usize] += pixel.as_dvec3();
    }
    let area = f64::from(side * side);
    sums.into_iter().map(|sum| sum / area).collect()
}

/// Means over runs and their standard errors, place by place.
fn over_runs(runs: &[Vec<DVec3>]) -> Vec<(DVec3, DVec3)> {
    let n = runs.len() as f64;
    let at = |i: usize| {
        let mean = runs.iter().map(|run| run[i]).sum::<DVec3>() / n;
        let squares = runs.iter().map(|run| (run[i] - mean).powf(2.0));
        let error = squares.sum::<DVec3>() / (n * (n - 1.0));
        (mean, error.map(f64::sqrt))
    };
    (0..runs[0].len()).map(at).collect()
}

/// Renders the scene and compares it with its reference: the whole, each block, and pixel by pixel.
fn assert_agrees(name: &str) {
    assert_looks_like(name, &scene(name));
}

fn scene(name: &str) -> Scene {
    let scene = read_pbrt(&folder().join(format!("{name}.pbrt"))).expect("a scene");
    assert_eq!(scene.warnings, [], "all of {name} is understood");
    scene
}

fn assert_looks_like(name: &str, scene: &Scene) {
    let reference = reference(name);
    let shot = Shot {
        size: SIZE,
        spp: SPP,
        max_depth: reference.depth,
        sampler: SamplerKind::Bvh,
        light_samples: LIGHT_SAMPLES,
        ..Shot::default()
    };
    let runs: Vec<_> = shot
        .render_each(scene, 0..=RUNS - 1)
        .map(|rendering| rendering.film.develop())
        .collect();
    let theirs = image(&format!("{name}.exr"));
    let at_scale = |side| {
        let runs: Vec<_> = runs.iter().map(|run| means(run, side)).collect();
        over_runs(&runs)
    };

    let (whole, error) = at_scale(SIZE)[0];
    let expected = means(&theirs, SIZE)[0];
    let z = (whole - expected) / (error * error + reference.error * reference.error).map(f64::sqrt);
    assert!(
        z.abs().max_element() < 4.5,
        "{name}: mean {whole}, theirs {expected}, {z} standard errors apart"
    );

    // Of several hundred blocks one may be far off; errors that are themselves estimated have
    // longer tails.
    let blocks = at_scale(BLOCK).into_iter().zip(means(&theirs, BLOCK));
    let errors = image(&format!("{name}-error.exr"));
    for (i, (((ours, error), theirs), their_error)) in blocks.zip(errors).enumerate() {
        let their_error = their_error.as_dvec3();
        let error = (error * error + their_error * their_error).map(f64::sqrt);
        let rounding = 1e-5;
        let off = (ours - theirs).abs() / (error + rounding);
        assert!(
            off.max_element() < 6.0,
            "{name}: block {i} is {ours}, theirs {theirs}, {off} standard errors apart"
        );
    }

    // What two unbiased pictures differ by is the noise of both.
    let pixels = at_scale(1);
    let ours: Vec<Vec3> = pixels.iter().map(|(mean, _)| mean.as_vec3()).collect();
    let comparison = Comparison::new(&ours, &theirs).expect("pictures of one size");
    let noise: f64 = pixels
        .iter()
        .zip(&theirs)
        .map(|((_, error), r)| {
            let r = r.as_dvec3();
            (error * error / (r * r + 1e-2)).element_sum()
        })
        .sum();
    let noise = noise / f64::from(3 * SIZE * SIZE) + reference.rel_mse;
    println!(
        "{name}: {z:.1} standard errors apart; relMSE {:.2e}, noise {noise:.2e}",
        comparison.rel_mse
    );
    assert!(
        comparison.rel_mse < 1.3 * noise,
        "{name}: relMSE {}, of which noise explains {noise}",
        comparison.rel_mse
    );
}

#[test]
fn a_room_with_color_bleeding() {
    assert_agrees("cornell");
}

#[test]
fn rough_copper_and_smooth_aluminium() {
    assert_agrees("metals");
}

#[test]
fn rough_and_smooth_and_thin_glass() {
    assert_agrees("glasses");
}

#[test]
fn paint_under_a_clear_coat() {
    assert_agrees("lacquer");
}

#[test]
fn spot_point_and_distant_lights() {
    assert_agrees("spots");
}

#[test]
fn a_lens_out_of_focus() {
    assert_agrees("lens");
}

#[test]
fn pictures_that_emit_and_that_are_lit() {
    assert_agrees("screen");
}

#[test]
fn three_hundred_lamps_by_the_light_tree() {
    assert_agrees("lanterns");
}

#[test]
fn rougher_metals() {
    assert_agrees("brushed");
}

#[test]
fn leaves_that_let_light_through() {
    assert_agrees("leaves");
}

#[test]
fn smoke_in_a_ball_under_a_lamp() {
    assert_agrees("fog");
}

#[test]
fn a_screen_with_holes() {
    assert_agrees("grille");
}

#[test]
fn a_picture_of_the_sky() {
    assert_agrees("clouds");
}

#[test]
fn the_same_sky_as_a_lat_long_picture() {
    let mut scene = scene("clouds");
    scene.lights.clear();
    let sky = read_image(&folder().join("clouds-lat-long.exr")).expect("an image");
    scene
        .add_sky(&sky.image, Affine3A::IDENTITY)
        .expect("a sky");
    assert_looks_like("clouds", &scene);
}

#[test]
fn copies_of_a_tree() {
    let scene = scene("orchard");
    assert_eq!(scene.instances.len(), 12, "stored once");
    assert_looks_like("orchard", &scene);
}
