use super::corners::corners;
use super::course::{Bank, Course};
use super::measures::WATER;
use super::palette::Palette;
use crate::MaterialId;
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec3};

/// Where boats are moored, and how long they are.
const MOORINGS: [(Bank, f32, f32); 8] = [
    (Bank::Left, 8.0, 9.0),
    (Bank::Left, 21.0, 6.0),
    (Bank::Left, 44.0, 10.0),
    (Bank::Left, 76.0, 9.0),
    (Bank::Right, 13.0, 7.0),
    (Bank::Right, 23.5, 8.0),
    (Bank::Right, 49.0, 9.0),
    (Bank::Right, 78.0, 8.0),
];

/// Moored boats with lit cabins.
pub(super) fn boats(modeller: &mut Modeller, palette: &Palette, dice: &mut Dice, course: &Course) {
    for (bank, along, length) in MOORINGS {
        let hull = dice.pick(&palette.colours);
        let transform = course.facing_water(bank, along, WATER - 1.5);
        boat(modeller, palette, dice, &transform, hull, length);
    }
}

/// A boat whose x axis is its length.
fn boat(
    modeller: &mut Modeller,
    palette: &Palette,
    dice: &mut Dice,
    transform: &Affine3A,
    hull: MaterialId,
    length: f32,
) {
    /// Half width and height of the rim, from stern to bow, over the length.
    const SHAPE: [(f32, f32, f32); 8] = [
        (-0.5, 0.75, 0.75),
        (-0.4, 1.0, 0.66),
        (-0.2, 1.12, 0.6),
        (0.0, 1.15, 0.58),
        (0.2, 1.1, 0.62),
        (0.36, 0.85, 0.72),
        (0.46, 0.42, 0.86),
        (0.52, 0.02, 1.0),
    ];
    let at = |(t, half, rim): (f32, f32, f32), side: f32, low: f32| {
        let y = if low > 0.0 { -0.2 } else { rim };
        let waist = 1.0 - 0.22 * low;
        transform.transform_point3(Vec3::new(t * length, y, side * half * waist))
    };
    for pair in SHAPE.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let front = [
            at(a, 1.0, 1.0),
            at(b, 1.0, 1.0),
            at(b, 1.0, 0.0),
            at(a, 1.0, 0.0),
        ];
        let back = [
            at(b, -1.0, 1.0),
            at(a, -1.0, 1.0),
            at(a, -1.0, 0.0),
            at(b, -1.0, 0.0),
        ];
        modeller.quad(hull, front);
        modeller.quad(hull, back);
        let deck = [
            at(a, 1.0, 0.0),
            at(b, 1.0, 0.0),
            at(b, -1.0, 0.0),
            at(a, -1.0, 0.0),
        ];
        modeller.quad(palette.bark, deck);
        for side in [-1.0, 1.0] {
            modeller.bar(
                palette.paint,
                [at(a, side, 0.0), at(b, side, 0.0)],
                [0.05, 0.05],
                4,
            );
        }
    }
    let stern = SHAPE[0];
    let transom = [
        at(stern, -1.0, 1.0),
        at(stern, 1.0, 1.0),
        at(stern, 1.0, 0.0),
        at(stern, -1.0, 0.0),
    ];
    modeller.quad(hull, transom);
    cabin(modeller, palette, dice, transform, length);
}

/// A cabin with three windows on each side.
fn cabin(
    modeller: &mut Modeller,
    palette: &Palette,
    dice: &mut Dice,
    transform: &Affine3A,
    length: f32,
) {
    let (x0, x1) = (-0.32 * length, 0.16 * length);
    let (low, high) = (Vec3::new(x0, 0.55, -0.72), Vec3::new(x1, 1.65, 0.72));
    modeller.block(palette.paint, transform, low, high);
    let (low, high) = (
        Vec3::new(x0 - 0.12, 1.65, -0.85),
        Vec3::new(x1 + 0.12, 1.74, 0.85),
    );
    modeller.block(palette.bark, transform, low, high);
    let room = dice.pick(&palette.rooms);
    let half_turn = Affine3A::from_rotation_y(core::f32::consts::PI);
    for side in [*transform, *transform * half_turn] {
        let mirrored = side.matrix3.z_axis.dot(transform.matrix3.z_axis) < 0.0;
        let [from, to] = if mirrored { [-x1, -x0] } else { [x0, x1] };
        for k in 0..3u8 {
            let share = (to - from) / 3.0;
            let x = from + share * f32::from(k);
            let [min, max] = corners([x + 0.18, x + share - 0.18], [0.95, 1.45]);
            modeller.panel(room[usize::from(k) % 2], &side, min, max, 0.73);
        }
    }
}
