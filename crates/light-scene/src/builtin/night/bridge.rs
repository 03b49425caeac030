use core::f32::consts::PI;

use super::lantern::lantern;
use super::measures::{QUAY, WATER};
use super::palette::Palette;
use crate::MaterialId;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec3};

/// Half of the bridge's width, along the canal.
const HALF_WIDTH: f32 = 2.6;

/// Half of the arch's span, across the canal.
const HALF_SPAN: f32 = 6.6;

/// How far the bridge reaches ashore from the middle.
const REACH: f32 = WATER + 3.0;

/// Pieces of each half of the bridge.
const PIECES: u16 = 24;

/// Radius of a bulb.
const BULB: f32 = 0.06;

/// An arched bridge over the canal, outlined with bulbs; at `transform` x runs across the canal and
/// z along it.
pub(super) fn bridge(modeller: &mut Modeller, palette: &Palette, transform: &Affine3A) {
    let across = |k: u16| REACH * (f32::from(k) / f32::from(PIECES) - 1.0);
    for k in 0..2 * PIECES {
        slice(modeller, palette, transform, [across(k), across(k + 1)]);
    }
    for z in [-HALF_WIDTH, HALF_WIDTH] {
        railing(modeller, palette, transform, z);
        outline(modeller, palette, transform, z);
    }
    for x in [-REACH + 1.2, REACH - 1.2] {
        for z in [-HALF_WIDTH, HALF_WIDTH] {
            let foot = Vec3::new(x, deck(x) - 0.02, z);
            let transform = *transform * Affine3A::from_translation(foot);
            lantern(modeller, palette, &transform, 2.7);
        }
    }
}

/// Height of the deck over the water, `x` metres from the middle.
fn deck(x: f32) -> f32 {
    QUAY + 1.45 * (0.5 + 0.5 * (PI * x / REACH).cos())
}

/// Height of the arch's underside; below the water outside of its span.
fn arch(x: f32) -> f32 {
    let t = x / HALF_SPAN;
    if t.abs() < 1.0 {
        2.35 * (1.0 - t * t).sqrt()
    } else {
        -0.5
    }
}

/// One slice across the canal: deck, both faces, underside.
fn slice(modeller: &mut Modeller, palette: &Palette, transform: &Affine3A, [a, b]: [f32; 2]) {
    let at = |x: f32, y: f32, z: f32| transform.transform_point3(Vec3::new(x, y, z));
    let w = HALF_WIDTH;
    let top = [
        at(a, deck(a), w),
        at(b, deck(b), w),
        at(b, deck(b), -w),
        at(a, deck(a), -w),
    ];
    modeller.quad(palette.paving, top);
    let under = [
        at(b, arch(b), w),
        at(a, arch(a), w),
        at(a, arch(a), -w),
        at(b, arch(b), -w),
    ];
    modeller.quad(palette.quay_wall, under);
    let face = |z: f32| {
        [
            at(a, arch(a), z),
            at(b, arch(b), z),
            at(b, deck(b), z),
            at(a, deck(a), z),
        ]
    };
    modeller.quad(palette.fronts[1], face(w));
    let [a, b, c, d] = face(-w);
    modeller.quad(palette.fronts[1], [b, a, d, c]);
}

/// A kerb, posts, and two rails.
fn railing(modeller: &mut Modeller, palette: &Palette, transform: &Affine3A, z: f32) {
    const POSTS: u16 = 26;
    let x = |k: u16| REACH * (2.0 * f32::from(k) / f32::from(POSTS) - 1.0);
    let at = |x: f32, above: f32| transform.transform_point3(Vec3::new(x, deck(x) + above, z));
    for k in 0..=POSTS {
        modeller.bar(
            palette.iron,
            [at(x(k), 0.0), at(x(k), 1.05)],
            [0.025, 0.02],
            4,
        );
        if k < POSTS {
            for (above, radius) in [(1.0, 0.03), (0.5, 0.018), (0.04, 0.09)] {
                let ends = [at(x(k), above), at(x(k + 1), above)];
                let material = if above < 0.1 {
                    palette.stone
                } else {
                    palette.iron
                };
                modeller.bar(material, ends, [radius, radius], 4);
            }
        }
    }
}

/// Bulbs along the arch and along the deck, on the face at `z`.
fn outline(modeller: &mut Modeller, palette: &Palette, transform: &Affine3A, z: f32) {
    let out = z + 0.12 * z.signum();
    let mut bulb = |material: MaterialId, x: f32, y: f32| {
        let center = transform.transform_point3(Vec3::new(x, y, out));
        modeller.octahedron(material, center, BULB);
    };
    const ARCH: u16 = 44;
    for k in 1..ARCH {
        // Equal angles of the ellipse are nearly equal distances here.
        let angle = PI * f32::from(k) / f32::from(ARCH);
        let x = -(HALF_SPAN + 0.2) * angle.cos();
        bulb(palette.bridge_bulb, x, 2.55 * angle.sin());
    }
    const DECK: u16 = 50;
    for k in 0..=DECK {
        let x = REACH * (2.0 * f32::from(k) / f32::from(DECK) - 1.0);
        bulb(palette.bridge_bulb, x, deck(x) - 0.1);
    }
}
