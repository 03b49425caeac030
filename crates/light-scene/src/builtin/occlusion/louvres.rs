use super::camera::camera;
use super::lamps::{Lamps, Spread};
use super::size::{count, growth};
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec2, Vec3};
use crate::{Material, MaterialId, Scene};

/// Side of the hall of a hundred lamps.
const SIDE: f32 = 12.0;

const HEIGHT: f32 = 4.2;

/// Between which heights the grille hangs.
const GRILLE: [f32; 2] = [3.45, 3.7];

/// From one slat to the next.
const PITCH: f32 = 0.3;

/// Depth of the chamber behind the slats of the far wall.
const CHAMBER: f32 = 0.7;

/// A hall: lamps over an egg-crate grille on one side and over slanted slats on the other, and
/// behind the slats of the far wall.
pub(super) fn louvres(lamps: usize, dice: &mut Dice) -> Scene {
    let side = SIDE * growth(lamps, 0.25);
    let mut modeller = Modeller::default();
    let m = &mut modeller;
    let plaster = m.material(Material::diffuse("plaster", Vec3::new(0.66, 0.65, 0.62)));
    let stone = m.material(Material::diffuse("stone", Vec3::new(0.45, 0.42, 0.38)));
    let slat = m.material(Material::diffuse("slat", Vec3::new(0.35, 0.35, 0.36)));
    let shape = Lamps::new(m);
    hall(m, [plaster, stone], side);
    grille(m, slat, side);
    slanted(m, slat, side);
    window(m, slat, side);
    exhibits(m, plaster, dice, side);
    // A quarter shines through the slats of the wall.
    let behind = lamps / 4;
    let half = 0.5 * side;
    let ceiling = [Vec2::splat(0.15 - half), Vec2::splat(half - 0.15)];
    let above = Spread::new(dice, lamps - behind, ceiling);
    for place in above.places {
        let center = Vec3::new(place.x, HEIGHT - 0.04, place.y);
        shape.add_square(m, dice, center, Vec3::NEG_Y, above.half);
    }
    let back = [Vec2::new(0.15 - half, 0.5), Vec2::new(half - 0.15, 3.2)];
    let wall = Spread::new(dice, behind, back);
    for place in wall.places {
        let center = Vec3::new(place.x, place.y, 0.04 - half - CHAMBER);
        shape.add_square(m, dice, center, Vec3::Z, wall.half);
    }
    let eye = Vec3::new(0.3, 1.7, 5.6 - half + 4.0);
    let mut scene = modeller.finish();
    scene.camera = Some(camera(eye, Vec3::new(-0.2, 1.35, -half), 70.0));
    scene
}

/// Floor, ceiling and walls; the far wall is that of the chamber.
fn hall(m: &mut Modeller, [plaster, stone]: [MaterialId; 2], side: f32) {
    let half = 0.5 * side;
    let [near, far] = [half, -half - CHAMBER];
    let corner = |x: f32, y: f32, z: f32| Vec3::new(x * half, y, z);
    let ground = [(-1.0, near), (1.0, near), (1.0, far), (-1.0, far)];
    m.quad(stone, ground.map(|(x, z)| corner(x, 0.0, z)));
    let mut ceiling = ground.map(|(x, z)| corner(x, HEIGHT, z));
    ceiling.reverse();
    m.quad(plaster, ceiling);
    for k in 0..4 {
        let ((ax, az), (bx, bz)) = (ground[k], ground[(k + 1) % 4]);
        let wall = [
            corner(ax, HEIGHT, az),
            corner(bx, HEIGHT, bz),
            corner(bx, 0.0, bz),
            corner(ax, 0.0, az),
        ];
        m.quad(plaster, wall);
    }
}

/// Upright blades along both axes under the left half of the ceiling.
fn grille(m: &mut Modeller, slat: MaterialId, side: f32) {
    let half = 0.5 * side;
    let blade = |[ax, az]: [f32; 2], [bx, bz]: [f32; 2]| {
        [
            Vec3::new(ax, GRILLE[0], az),
            Vec3::new(bx, GRILLE[0], bz),
            Vec3::new(bx, GRILLE[1], bz),
            Vec3::new(ax, GRILLE[1], az),
        ]
    };
    for k in 0..=count(half / PITCH) {
        let x = -PITCH * f32::from(k);
        m.quad(slat, blade([x, -half], [x, half]));
    }
    for k in 1..count(side / PITCH) {
        let z = PITCH * f32::from(k) - half;
        m.quad(slat, blade([-half, z], [0.0, z]));
    }
}

/// Slats along z under the right half of the ceiling, each slanted.
fn slanted(m: &mut Modeller, slat: MaterialId, side: f32) {
    let half = 0.5 * side;
    for k in 0..count(half / PITCH) {
        let x = PITCH * (f32::from(k) + 0.5);
        let [low, high] = [x - 0.11, x + 0.11];
        let corners = [
            Vec3::new(low, GRILLE[0], half),
            Vec3::new(high, GRILLE[1], half),
            Vec3::new(high, GRILLE[1], -half),
            Vec3::new(low, GRILLE[0], -half),
        ];
        m.quad(slat, corners);
    }
}

/// Slats before the chamber, slanted so that they send the light down.
fn window(m: &mut Modeller, slat: MaterialId, side: f32) {
    let half = 0.5 * side;
    for k in 0..count(GRILLE[0] / (0.5 * PITCH)) {
        let y = 0.5 * PITCH * (f32::from(k) + 0.5);
        let corners = [
            Vec3::new(-half, y - 0.1, 0.07 - half),
            Vec3::new(half, y - 0.1, 0.07 - half),
            Vec3::new(half, y + 0.1, -0.07 - half),
            Vec3::new(-half, y + 0.1, -0.07 - half),
        ];
        m.quad(slat, corners);
    }
}

/// Blocks on the floor, and a few balls.
fn exhibits(m: &mut Modeller, plaster: MaterialId, dice: &mut Dice, side: f32) {
    let half = 0.5 * side;
    let ends = [Vec2::splat(1.0 - half), Vec2::splat(half - 1.0)];
    let per_side = count(side / 4.0);
    let places = Spread::new(dice, usize::from(per_side * per_side), ends).places;
    for place in places {
        let turn = Affine3A::from_rotation_y(dice.between(0.0, core::f32::consts::TAU));
        let at = Affine3A::from_translation(Vec3::new(place.x, 0.0, place.y)) * turn;
        let top = dice.between(0.4, 1.1);
        let low = Vec3::new(-0.35, 0.0, -0.35);
        m.block(plaster, &at, low, Vec3::new(0.35, top, 0.35));
    }
    for x in [-1.6, 1.4] {
        m.sphere(plaster, Vec3::new(x, 0.45, 2.2 - half), 0.45);
    }
}
