use core::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};
use light_math::{Frame, float};

use super::place::Place;
use crate::random::Random;

/// Spheres of triangles over a floor, at least as many triangles as a small lamp has.
pub(super) fn bulbs(r: &mut Random, place: &mut Place) {
    let (around, along) = (6 + r.below(6), 4 + r.below(4));
    let triangles = 2 * around * (along - 1);
    let count = place.n().div_ceil(triangles);
    let side = (count as f32).sqrt() * r.between(1.0, 3.0);
    let radius = r.between(0.03, 0.15);
    let decades = 2.0 * r.unit();
    while place.wants_lights() {
        let center = Vec3::new(r.unit() * side, r.unit() * side, r.between(1.8, 3.0));
        let power = 60.0 * r.log_uniform(decades) / triangles as f32;
        let corner = |i: usize, j: usize| {
            let (s, c) = float::sin_cos(TAU * i as f32 / around as f32);
            let (ring, z) = float::sin_cos(PI * j as f32 / along as f32);
            center + Vec3::new(c * ring, s * ring, z) * radius
        };
        for j in 0..along {
            for i in 0..around {
                let [a, b, c, d] = [
                    corner(i, j),
                    corner(i, j + 1),
                    corner(i + 1, j + 1),
                    corner(i + 1, j),
                ];
                if j + 1 < along {
                    place.triangle([a, b, c], power, false);
                }
                if j > 0 {
                    place.triangle([a, c, d], power, false);
                }
            }
        }
    }
    floor_and_air(r, place, side);
}

/// Tubes of triangles in any level direction; every second place has them two-sided.
pub(super) fn tubes(r: &mut Random, place: &mut Place) {
    let (around, along) = (4 + r.below(5), 3 + r.below(8));
    let triangles = 2 * around * along;
    let count = place.n().div_ceil(triangles);
    let side = (count as f32).sqrt() * r.between(1.5, 3.0);
    let radius = r.between(0.01, 0.03);
    let two_sided = r.unit() < 0.5;
    while place.wants_lights() {
        let center = Vec3::new(r.unit() * side, r.unit() * side, r.between(2.2, 3.2));
        let frame = Frame::from_z(r.level_direction());
        let length = r.between(0.6, 1.5);
        let corner = |i: usize, j: usize| {
            let (s, c) = float::sin_cos(TAU * i as f32 / around as f32);
            let t = j as f32 / along as f32 - 0.5;
            center + (frame.x * c + frame.y * s) * radius + frame.z * (t * length)
        };
        for (i, j) in (0..around).flat_map(|i| (0..along).map(move |j| (i, j))) {
            let power = 36.0 / triangles as f32;
            let [a, b, c, d] = [
                corner(i, j),
                corner(i + 1, j),
                corner(i + 1, j + 1),
                corner(i, j + 1),
            ];
            place.triangle([a, b, c], power, two_sided);
            place.triangle([a, c, d], power, two_sided);
        }
    }
    floor_and_air(r, place, side);
}

/// Receivers on the floor and, of any direction, in the air.
fn floor_and_air(r: &mut Random, place: &mut Place, side: f32) {
    while place.wants_points() {
        let at = Vec2::new(r.unit(), r.unit()) * side;
        if r.unit() < 0.6 {
            place.point(at.extend(0.0), Vec3::Z);
        } else {
            let n = r.direction();
            place.point(at.extend(r.between(0.2, 3.2)), n);
        }
    }
}
