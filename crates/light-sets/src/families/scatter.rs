use core::f32::consts::TAU;

use glam::Vec3;
use light_math::float;

use super::place::Place;
use crate::random::Random;
use crate::set_light::SetLight;

/// Receivers of any direction in a cube.
fn in_cube(r: &mut Random, place: &mut Place, side: f32) {
    while place.wants_points() {
        let (p, n) = (r.cube() * side, r.direction());
        place.point(p, n);
    }
}

/// The share of the mean distance of `n` lights in a unit cube.
fn spacing(n: usize) -> f32 {
    float::powf(n as f32, -1.0 / 3.0)
}

/// Isotropic points in a cube.
pub(super) fn points(r: &mut Random, place: &mut Place) {
    let decades = 3.0 * r.unit();
    while place.wants_lights() {
        let (p, intensity) = (r.cube(), r.log_uniform(decades));
        place.light(SetLight::Point { p, intensity });
    }
    in_cube(r, place, 1.0);
}

/// Crowns of leaves, one leaf in a hundred bright; receivers on the ground and in the crowns.
pub(super) fn foliage(r: &mut Random, place: &mut Place) {
    let trees = place.n().isqrt() / 5 + 1;
    let side = (trees as f32).sqrt() * r.between(4.0, 10.0);
    let crown = Vec3::new(1.0, 1.0, r.between(0.8, 2.0)) * r.between(1.0, 3.0);
    let leaf = r.between(0.02, 0.08);
    let bright = r.log_uniform(2.0) * 100.0;
    let trees: Vec<Vec3> = (0..trees)
        .map(|_| Vec3::new(r.unit() * side, r.unit() * side, r.between(3.0, 6.0)))
        .collect();
    let inside = |r: &mut Random| {
        let away = float::cbrt(r.unit());
        trees[r.below(trees.len())] + r.direction() * away * crown
    };
    while place.wants_lights() {
        let center = inside(r);
        let power = if r.unit() < 0.01 { bright } else { 1.0 } * r.log_uniform(1.0);
        let n = r.direction();
        place.light(r.triangle(center, n, leaf, power, true));
    }
    while place.wants_points() {
        if r.unit() < 0.6 {
            place.point(Vec3::new(r.unit() * side, r.unit() * side, 0.0), Vec3::Z);
        } else {
            let (p, n) = (inside(r), r.direction());
            place.point(p, n);
        }
    }
}

/// A ground of triangles that shine upward; receivers of any direction over it.
pub(super) fn terrain(r: &mut Random, place: &mut Place) {
    let cells = (place.n() / 2).isqrt().max(1) + 1;
    let waves: Vec<[f32; 4]> = (0..6)
        .map(|k| {
            let rate = (1 << k) as f32 * TAU;
            [
                rate * r.between(-1.0, 1.0),
                rate * r.between(-1.0, 1.0),
                TAU * r.unit(),
                0.05 / rate,
            ]
        })
        .collect();
    let relief = r.between(0.2, 8.0);
    let height = |x: f32, y: f32| {
        let wave = |&[a, b, phase, size]: &[f32; 4]| float::sin(a * x + b * y + phase) * size;
        relief * waves.iter().map(wave).sum::<f32>()
    };
    let corner = |i: usize, j: usize| {
        let (x, y) = (i as f32 / cells as f32, j as f32 / cells as f32);
        Vec3::new(x, y, height(x, y))
    };
    let mut order: Vec<usize> = (0..cells * cells).collect();
    r.shuffle(&mut order);
    let decades = 2.0 * r.unit();
    for cell in order {
        let (i, j) = (cell % cells, cell / cells);
        let [a, b, c, d] = [
            corner(i, j),
            corner(i + 1, j),
            corner(i + 1, j + 1),
            corner(i, j + 1),
        ];
        let power = r.log_uniform(decades);
        place.triangle([a, b, c], power, false);
        place.triangle([a, c, d], power, false);
    }
    while place.wants_points() {
        let (x, y) = (r.unit(), r.unit());
        let z = height(x, y) + 0.002 * r.log_uniform(2.0);
        let n = r.direction();
        place.point(Vec3::new(x, y, z), n);
    }
}

/// Clusters of clusters of small triangles; receivers near them and anywhere.
pub(super) fn nested_clusters(r: &mut Random, place: &mut Place) {
    let outer = 3 + r.below(8);
    let inner = 3 + r.below(20);
    let (wide, narrow) = (r.between(0.05, 0.2), r.between(0.005, 0.03));
    let centers: Vec<Vec3> = (0..outer)
        .flat_map(|_| {
            let center = r.cube();
            (0..inner)
                .map(|_| center + (r.cube() - 0.5) * wide)
                .collect::<Vec<_>>()
        })
        .collect();
    let size = 0.3 * narrow * spacing((place.n() / centers.len()).max(1));
    while place.wants_lights() {
        let center = centers[r.below(centers.len())] + (r.cube() - 0.5) * narrow;
        let (n, power) = (r.direction(), r.log_uniform(2.0));
        place.light(r.triangle(center, n, size, power, false));
    }
    while place.wants_points() {
        let p = if r.unit() < 0.5 {
            centers[r.below(centers.len())] + (r.cube() - 0.5) * (2.0 * wide)
        } else {
            r.cube()
        };
        let n = r.direction();
        place.point(p, n);
    }
}

/// Dim triangles in a cube and some five to twenty very bright ones.
pub(super) fn few_bright(r: &mut Random, place: &mut Place) {
    let bright = 5 + r.below(15);
    let factor = 1000.0 * r.log_uniform(3.0);
    let size = 0.3 * spacing(place.n());
    for i in 0..place.n() {
        let (center, n) = (r.cube(), r.direction());
        let power = if i < bright { factor } else { 1.0 } * r.log_uniform(1.0);
        place.light(r.triangle(center, n, size, power, false));
    }
    in_cube(r, place, 1.0);
}

/// Triangles of sizes over three decades with one radiance, some two-sided.
pub(super) fn sizes(r: &mut Random, place: &mut Place) {
    let largest = 2.0 * spacing(place.n());
    let two_sided = r.between(0.0, 0.6);
    while place.wants_lights() {
        let size = largest / r.log_uniform(3.0);
        let (center, n, both) = (r.cube(), r.direction(), r.unit() < two_sided);
        place.light(r.triangle(center, n, size, size * size, both));
    }
    in_cube(r, place, 1.0);
}

/// Triangles of any direction in a thin slab, and receivers in it that face along or across it.
pub(super) fn grazing(r: &mut Random, place: &mut Place) {
    let thin = Vec3::new(1.0, 1.0, 0.001 * r.log_uniform(2.0));
    let size = 0.3 / (place.n() as f32).sqrt();
    let tilt = r.unit();
    while place.wants_lights() {
        let n = (Vec3::Z * if r.unit() < 0.5 { 1.0 } else { -1.0 } + r.direction() * tilt)
            .normalize_or(Vec3::Z);
        let (center, power) = (r.cube() * thin, r.log_uniform(2.0));
        place.light(r.triangle(center, n, size, power, false));
    }
    while place.wants_points() {
        let p = r.cube() * thin;
        let n = if r.unit() < 0.5 {
            r.level_direction()
        } else {
            r.direction()
        };
        place.point(p, n);
    }
}
