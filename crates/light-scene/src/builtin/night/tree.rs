use super::course::{Bank, Course};
use super::measures::{QUAY, WATER};
use super::palette::Palette;
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::Vec3;

/// Radius of a bulb.
const BULB: f32 = 0.04;

/// Positions of the trees along each quay.
const PLACES: [(Bank, f32); 9] = [
    (Bank::Left, 3.5),
    (Bank::Left, 24.0),
    (Bank::Left, 43.0),
    (Bank::Left, 55.0),
    (Bank::Left, 72.0),
    (Bank::Right, 5.5),
    (Bank::Right, 23.0),
    (Bank::Right, 48.0),
    (Bank::Right, 74.0),
];

/// A piece of a branch, thick enough to carry bulbs or thin enough to need them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Branch {
    from: Vec3,
    to: Vec3,
    radius: f32,
}

/// Adds bare trees along the quays; returns their branches without the trunks.
pub(super) fn trees(
    modeller: &mut Modeller,
    palette: &Palette,
    dice: &mut Dice,
    course: &Course,
) -> Vec<Branch> {
    let mut twigs = Vec::new();
    for (bank, along) in PLACES {
        let foot = course.facing_water(bank, along, WATER + 2.2).translation;
        let foot = Vec3::from(foot) + Vec3::Y * QUAY;
        let trunk = Branch {
            from: foot,
            to: foot + Vec3::new(dice.between(-0.2, 0.2), 2.6, dice.between(-0.2, 0.2)),
            radius: 0.16,
        };
        grow(modeller, palette, dice, trunk, &mut twigs);
    }
    twigs
}

/// Builds a branch and all that grow from it.
fn grow(
    modeller: &mut Modeller,
    palette: &Palette,
    dice: &mut Dice,
    trunk: Branch,
    twigs: &mut Vec<Branch>,
) {
    let mut growing = vec![(trunk, 0)];
    while let Some((branch, age)) = growing.pop() {
        let radius = [branch.radius, 0.7 * branch.radius];
        modeller.bar(palette.bark, [branch.from, branch.to], radius, 5);
        if age > 0 {
            twigs.push(branch);
        }
        if age == 5 {
            continue;
        }
        let way = branch.to - branch.from;
        let (u, v) = way.normalize_or(Vec3::Y).any_orthonormal_pair();
        let turn = dice.between(0.0, core::f32::consts::TAU);
        let forks = if age == 0 { 4u8 } else { dice.pick(&[2, 2, 3]) };
        for k in 0..forks {
            let angle = turn + core::f32::consts::TAU * f32::from(k) / f32::from(forks);
            let aside = u * angle.cos() + v * angle.sin();
            let spread = dice.between(0.45, 0.75);
            // Branches grow upward.
            let way = way.normalize_or(Vec3::Y) + aside * spread + Vec3::Y * 0.18;
            let length = if age == 0 {
                1.5
            } else {
                0.80 * (branch.to - branch.from).length()
            };
            let child = Branch {
                from: branch.to,
                to: branch.to + way.normalize_or(Vec3::Y) * length * dice.between(0.8, 1.1),
                radius: 0.62 * branch.radius,
            };
            growing.push((child, age + 1));
        }
    }
}

/// Spreads bulbs of `triangles` triangles in all over the branches: eight a bulb, and single ones
/// at the end where the number asks for it.
pub(super) fn bulbs(
    modeller: &mut Modeller,
    palette: &Palette,
    dice: &mut Dice,
    branches: &[Branch],
    triangles: usize,
) {
    let place = |dice: &mut Dice| {
        let branch = dice.pick(branches);
        let aside = Vec3::new(
            dice.between(-1.0, 1.0),
            dice.between(-1.0, 1.0),
            dice.between(-1.0, 1.0),
        );
        let on = branch.from.lerp(branch.to, dice.unit());
        on + aside.normalize_or(Vec3::Y) * (branch.radius + BULB)
    };
    for _ in 0..triangles / 8 {
        let center = place(dice);
        modeller.octahedron(palette.tree_bulb, center, BULB);
    }
    for _ in 0..triangles % 8 {
        let p = place(dice);
        let spark = [p, p + Vec3::X * BULB, p + Vec3::Y * BULB];
        modeller.triangle(palette.tree_bulb, spark);
    }
}
