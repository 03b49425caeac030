use core::f32::consts::TAU;

use super::course::{Bank, Course};
use super::measures::{FRONTS, QUAY};
use super::palette::Palette;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec3};

/// A church tower behind the houses of the bend.
pub(super) fn tower(modeller: &mut Modeller, palette: &Palette, course: &Course) {
    let mut transform = course.facing_water(Bank::Left, 72.0, FRONTS + 19.0);
    transform.translation.y += QUAY;
    // Storeys from the ground up: height of the top, and half width.
    let storeys = [(17.0, 3.6), (23.0, 3.0), (27.0, 2.3), (30.0, 1.6)];
    let mut bottom = 0.0;
    for (top, half) in storeys {
        let (low, high) = (Vec3::new(-half, bottom, -half), Vec3::new(half, top, half));
        modeller.block(palette.stone, &transform, low, high);
        let rim = Vec3::new(half + 0.3, 0.2, half + 0.3);
        let edge = Vec3::Y * top;
        modeller.block(palette.paint, &transform, edge - rim, edge + rim);
        bottom = top;
    }
    spire(modeller, palette, &transform, bottom);
    for quarter in 0..4u8 {
        let turn = Affine3A::from_rotation_y(0.25 * TAU * f32::from(quarter));
        let face = transform * turn;
        clock(modeller, palette, &face, Vec3::new(0.0, 20.0, 3.05));
        for x in [-2.0, 0.0, 2.0] {
            flood(modeller, palette, &face, Vec3::new(x, 17.25, 3.75));
            flood(modeller, palette, &face, Vec3::new(0.6 * x, 23.25, 3.15));
        }
    }
}

fn spire(modeller: &mut Modeller, palette: &Palette, transform: &Affine3A, bottom: f32) {
    let at = |y: f32| transform.transform_point3(Vec3::Y * y);
    let profile = [(0.0, 1.5), (1.2, 1.7), (2.6, 1.0), (4.2, 0.55), (9.0, 0.03)];
    for pair in profile.windows(2) {
        let ends = [at(bottom + pair[0].0), at(bottom + pair[1].0)];
        modeller.bar(palette.tiles, ends, [pair[0].1, pair[1].1], 8);
    }
}

/// A lit dial of sixteen triangles, with hands at ten past ten.
fn clock(modeller: &mut Modeller, palette: &Palette, face: &Affine3A, middle: Vec3) {
    const RADIUS: f32 = 1.35;
    const PIECES: u8 = 16;
    let rim = |k: u8, radius: f32, z: f32| {
        let angle = TAU * f32::from(k) / f32::from(PIECES);
        let on = Vec3::new(angle.cos() * radius, angle.sin() * radius, z);
        face.transform_point3(middle + on)
    };
    let center = face.transform_point3(middle);
    for k in 0..PIECES {
        modeller.triangle(
            palette.clock,
            [center, rim(k, RADIUS, 0.0), rim(k + 1, RADIUS, 0.0)],
        );
        let ends = [rim(k, RADIUS, 0.02), rim(k + 1, RADIUS, 0.02)];
        modeller.bar(palette.iron, ends, [0.08, 0.08], 4);
    }
    for (angle, length) in [(2.62f32, 0.75f32), (0.52, 1.1)] {
        let tip = Vec3::new(angle.cos(), angle.sin(), 0.0) * length;
        let ends = [Vec3::ZERO, tip].map(|p| face.transform_point3(middle + p + Vec3::Z * 0.05));
        modeller.bar(palette.iron, ends, [0.07, 0.04], 4);
    }
}

/// A floodlight that lies on a ledge and emits light upward along the wall.
fn flood(modeller: &mut Modeller, palette: &Palette, face: &Affine3A, at: Vec3) {
    let corner = |x: f32, y: f32, z: f32| face.transform_point3(at + Vec3::new(x, y, z));
    // Tilted toward the wall.
    let corners = [
        corner(-0.3, 0.16, 0.1),
        corner(0.3, 0.16, 0.1),
        corner(0.3, 0.06, -0.1),
        corner(-0.3, 0.06, -0.1),
    ];
    modeller.quad(palette.flood, corners);
}
