use super::camera::camera;
use super::lamps::{Lamps, Spread};
use super::size::count;
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec2, Vec3};
use crate::{Material, MaterialId, Scene};

/// Along x and z, from the middle of one wall to that of the next.
const ROOM: Vec2 = Vec2::new(5.0, 4.0);

const HEIGHT: f32 = 2.8;

/// Half the thickness of a wall.
const HALF_WALL: f32 = 0.08;

/// Width and height of a door.
const DOOR: Vec2 = Vec2::new(1.0, 2.1);

/// From a wall or a ceiling to the lamps on it.
const GAP: f32 = 0.03;

/// Rooms in a square, each joined by doors to its neighbours, with lamps at ceilings and walls.
pub(super) fn rooms(lamps: usize, dice: &mut Dice) -> Scene {
    let side = count((lamps as f32).powf(0.3)).max(3);
    let mut modeller = Modeller::default();
    let m = &mut modeller;
    let plaster = m.material(Material::diffuse("plaster", Vec3::new(0.7, 0.68, 0.63)));
    let boards = m.material(Material::diffuse("boards", Vec3::new(0.42, 0.30, 0.2)));
    let wood = m.material(Material::diffuse("wood", Vec3::new(0.3, 0.17, 0.1)));
    let shape = Lamps::new(m);
    shell(m, plaster, boards, side);
    walls(m, plaster, dice, side);
    let all = (0..side).flat_map(|j| (0..side).map(move |i| [i, j]));
    for [i, j] in all.clone() {
        if dice.chance(0.7) {
            furnish(m, wood, dice, corner(i, j) + 0.5 * ROOM);
        }
    }
    let lit: Vec<[u16; 2]> = all.filter(|&room| !is_dark(room, side)).collect();
    for (k, &[i, j]) in lit.iter().enumerate() {
        let here = lamps * (k + 1) / lit.len() - lamps * k / lit.len();
        light(m, &shape, dice, corner(i, j), here);
    }
    // From one corner of a dark room to the doors in the walls opposite.
    let at = corner(side / 2, side / 2);
    let inside = |x: f32, y: f32, z: f32| Vec3::new(at.x + x, y, at.y + z);
    let mut scene = modeller.finish();
    scene.camera = Some(camera(
        inside(0.4, 1.6, ROOM.y - 0.4),
        inside(3.6, 1.0, 0.6),
        72.0,
    ));
    scene
}

/// The corner of a room with the least coordinates.
fn corner(i: u16, j: u16) -> Vec2 {
    Vec2::new(f32::from(i), f32::from(j)) * ROOM
}

/// Whether a room has no lamp: every fifth, none of which has a dark neighbour.
fn is_dark([i, j]: [u16; 2], side: u16) -> bool {
    let line = |i: u16, j: u16| (i + 2 * j) % 5;
    line(i, j) == line(side / 2, side / 2)
}

/// Floor, ceiling and the walls around all rooms.
fn shell(m: &mut Modeller, plaster: MaterialId, boards: MaterialId, side: u16) {
    let end = corner(side, side);
    let flat = |y: f32, turned: bool| {
        let around = [(0.0, end.y), (end.x, end.y), (end.x, 0.0), (0.0, 0.0)];
        let mut corners = around.map(|(x, z)| Vec3::new(x, y, z));
        if turned {
            corners.reverse();
        }
        corners
    };
    m.quad(boards, flat(0.0, false));
    m.quad(plaster, flat(HEIGHT, true));
    for (a, b) in [
        (Vec2::ZERO, Vec2::new(end.x, 0.0)),
        (Vec2::new(0.0, end.y), end),
        (Vec2::ZERO, Vec2::new(0.0, end.y)),
        (Vec2::new(end.x, 0.0), end),
    ] {
        piece(m, plaster, [a, b], [0.0, HEIGHT]);
    }
}

/// The walls between rooms, each with a door.
fn walls(m: &mut Modeller, plaster: MaterialId, dice: &mut Dice, side: u16) {
    for line in 1..side {
        for k in 0..side {
            for (start, axis, length) in [
                (corner(line, k), Vec2::Y, ROOM.y),
                (corner(k, line), Vec2::X, ROOM.x),
            ] {
                let door = dice.between(0.5, length - 0.5 - DOOR.x);
                let at = |t: f32| start + axis * t;
                piece(m, plaster, [start, at(door)], [0.0, HEIGHT]);
                piece(m, plaster, [at(door), at(door + DOOR.x)], [DOOR.y, HEIGHT]);
                piece(m, plaster, [at(door + DOOR.x), at(length)], [0.0, HEIGHT]);
            }
        }
    }
}

/// A piece of wall from one point of the plan to another, along an axis, between two heights.
fn piece(m: &mut Modeller, plaster: MaterialId, [a, b]: [Vec2; 2], [low, high]: [f32; 2]) {
    let across = if (b - a).x > (b - a).y {
        Vec2::Y
    } else {
        Vec2::X
    } * HALF_WALL;
    let (min, max) = (a - across, b + across);
    m.block(
        plaster,
        &Affine3A::IDENTITY,
        Vec3::new(min.x, low, min.y),
        Vec3::new(max.x, high, max.y),
    );
}

/// A table and two stools around `middle`.
fn furnish(m: &mut Modeller, wood: MaterialId, dice: &mut Dice, middle: Vec2) {
    let turn = Affine3A::from_rotation_y(dice.between(0.0, core::f32::consts::TAU));
    let at = Affine3A::from_translation(Vec3::new(middle.x, 0.0, middle.y)) * turn;
    let mut solid = |low: [f32; 3], high: [f32; 3]| {
        m.block(wood, &at, Vec3::from(low), Vec3::from(high));
    };
    solid([-0.7, 0.72, -0.4], [0.7, 0.76, 0.4]);
    for (x, z) in [(-0.65, -0.35), (-0.65, 0.35), (0.65, -0.35), (0.65, 0.35)] {
        solid([x - 0.03, 0.0, z - 0.03], [x + 0.03, 0.72, z + 0.03]);
    }
    for z in [-0.75, 0.75] {
        solid([-0.2, 0.0, z - 0.2], [0.2, 0.45, z + 0.2]);
    }
}

/// The lamps of a room: two thirds at the ceiling, the others high on its walls.
fn light(m: &mut Modeller, shape: &Lamps, dice: &mut Dice, corner: Vec2, lamps: usize) {
    let on_walls = lamps / 3;
    let ends = [corner + 0.4, corner + ROOM - 0.4];
    let ceiling = Spread::new(dice, lamps - on_walls, ends);
    for place in ceiling.places {
        let center = Vec3::new(place.x, HEIGHT - GAP, place.y);
        shape.add_square(m, dice, center, Vec3::NEG_Y, ceiling.half);
    }
    let inner = [corner + HALF_WALL + GAP, corner + ROOM - HALF_WALL - GAP];
    for wall in 0..4 {
        let here = on_walls * (wall + 1) / 4 - on_walls * wall / 4;
        // Above the doors: places along the wall, at heights between two.
        let along_z = wall < 2;
        let length = if along_z { ROOM.y } else { ROOM.x };
        let ends = [Vec2::new(0.4, DOOR.y + 0.1), Vec2::new(length - 0.4, 2.6)];
        let spread = Spread::new(dice, here, ends);
        let (edge, sign) = if wall % 2 == 0 {
            (inner[0], 1.0)
        } else {
            (inner[1], -1.0)
        };
        for place in spread.places {
            let (center, toward) = if along_z {
                (Vec3::new(edge.x, place.y, corner.y + place.x), Vec3::X)
            } else {
                (Vec3::new(corner.x + place.x, place.y, edge.y), Vec3::Z)
            };
            shape.add_square(m, dice, center, toward * sign, spread.half);
        }
    }
}
