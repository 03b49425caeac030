use super::camera::camera;
use super::lamps::{Lamps, Spread};
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec2, Vec3};
use crate::{Material, MaterialId, Scene};

const SLABS: u16 = 20;

/// From the top of one slab to that of the next.
const STOREY: f32 = 3.0;

const THICKNESS: f32 = 0.3;

/// Half the side of a slab, and of the hole in its middle.
const HALF: f32 = 12.0;
const HOLE: f32 = 4.0;

/// A slab in plan: four rectangles around the hole, each with its share of eight lamps.
const PARTS: [([Vec2; 2], usize); 4] = [
    ([Vec2::new(-HALF, HOLE), Vec2::new(HALF, HALF)], 3),
    ([Vec2::new(-HALF, -HALF), Vec2::new(HALF, -HOLE)], 3),
    ([Vec2::new(-HALF, -HOLE), Vec2::new(-HOLE, HOLE)], 1),
    ([Vec2::new(HOLE, -HOLE), Vec2::new(HALF, HOLE)], 1),
];

/// Slabs around an atrium: lamps under each of them, and some that stand on the floors and light
/// the ceilings.
pub(super) fn slabs(lamps: usize, dice: &mut Dice) -> Scene {
    let mut modeller = Modeller::default();
    let m = &mut modeller;
    let concrete = m.material(Material::diffuse("concrete", Vec3::new(0.52, 0.51, 0.48)));
    let paint = m.material(Material::diffuse("paint", Vec3::new(0.72, 0.7, 0.66)));
    let wood = m.material(Material::diffuse("desk", Vec3::new(0.35, 0.2, 0.11)));
    let shape = Lamps::new(m);
    solid(m, concrete, [-HALF, -THICKNESS, -HALF], [HALF, 0.0, HALF]);
    for k in 0..SLABS {
        let floor = STOREY * f32::from(k);
        storey(m, [concrete, paint, wood], dice, floor);
        let part = |k: u16| lamps * usize::from(k) / usize::from(SLABS);
        light(m, &shape, dice, floor, part(k + 1) - part(k));
    }
    let floor = STOREY * f32::from(SLABS / 2);
    let eye = Vec3::new(-4.8, floor + 1.75, 1.2);
    let mut scene = modeller.finish();
    scene.camera = Some(camera(eye, Vec3::new(4.0, floor - 0.9, -1.2), 72.0));
    scene
}

fn solid(m: &mut Modeller, material: MaterialId, low: [f32; 3], high: [f32; 3]) {
    let (low, high) = (Vec3::from(low), Vec3::from(high));
    m.block(material, &Affine3A::IDENTITY, low, high);
}

/// The slab above a floor, what carries it, a parapet around the hole, and desks.
fn storey(m: &mut Modeller, [concrete, paint, wood]: [MaterialId; 3], dice: &mut Dice, floor: f32) {
    let top = floor + STOREY;
    for ([min, max], _) in PARTS {
        let low = [min.x, top - THICKNESS, min.y];
        solid(m, concrete, low, [max.x, top, max.y]);
    }
    // Columns stand in the hole, before the edge of the slabs.
    for (x, z) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
        let [x, z] = [x, z].map(|side| side * (HOLE - 0.2));
        let low = [x - 0.2, floor, z - 0.2];
        solid(m, concrete, low, [x + 0.2, top, z + 0.2]);
    }
    // The ground has no hole.
    if floor > 0.0 {
        for side in [-HOLE, HOLE] {
            let [near, far] = [side - 0.05, side + 0.05];
            let rail = [floor, floor + 0.95];
            solid(m, paint, [near, rail[0], -HOLE], [far, rail[1], HOLE]);
            solid(m, paint, [-HOLE, rail[0], near], [HOLE, rail[1], far]);
        }
    }
    for ([min, max], share) in PARTS {
        for place in Spread::new(dice, 2 * share, [min + 1.5, max - 1.5]).places {
            let turn = Affine3A::from_rotation_y(dice.between(0.0, core::f32::consts::TAU));
            let at = Affine3A::from_translation(Vec3::new(place.x, floor, place.y)) * turn;
            let half = Vec3::new(0.8, 0.0, 0.4);
            m.block(wood, &at, -half, half + Vec3::Y * 0.74);
        }
    }
}

/// The lamps of a storey: every fourth stands on the floor and shines up, the others hang under the
/// ceiling.
fn light(m: &mut Modeller, shape: &Lamps, dice: &mut Dice, floor: f32, lamps: usize) {
    let shares: usize = PARTS.iter().map(|(_, share)| share).sum();
    let mut first = 0;
    for (ends, share) in PARTS {
        let part = |shares_before: usize| lamps * shares_before / shares;
        let here = part(first + share) - part(first);
        first += share;
        let spread = Spread::new(dice, here, ends);
        for (k, place) in (0..).zip(spread.places) {
            let (height, toward) = if k % 4 == 1 {
                (1.9, Vec3::Y)
            } else {
                (STOREY - THICKNESS - 0.03, Vec3::NEG_Y)
            };
            let center = Vec3::new(place.x, floor + height, place.y);
            shape.add_square(m, dice, center, toward, spread.half);
        }
    }
}
