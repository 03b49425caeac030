use super::course::{Bank, Course};
use super::facade::wall;
use super::gable_style::Gable;
use super::measures::{FRONTS, QUAY};
use super::palette::Palette;
use super::window::{Content, Opening};
use crate::MaterialId;
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec3};

/// From front to back.
const DEPTH: f32 = 10.0;

/// The distances along the fronts at which the rows begin and end.
const ROW: [f32; 2] = [-22.0, 128.0];

/// One house as the dice made it.
#[derive(Clone, Debug)]
pub(super) struct House {
    pub(super) width: f32,
    /// Height of the ground floor, then of each floor above it.
    floors: Vec<f32>,
    windows: u16,
    pub(super) front: MaterialId,
    door: MaterialId,
    pub(super) style: Gable,
}

/// The houses of one bank, wall to wall.
pub(super) fn row(
    modeller: &mut Modeller,
    palette: &Palette,
    dice: &mut Dice,
    course: &Course,
    bank: Bank,
) {
    let mut at = ROW[0];
    while at < ROW[1] {
        let house = House::new(palette, dice);
        let middle = course.along(bank, FRONTS, at + 0.5 * house.width);
        let transform = course.facing_water(bank, middle, FRONTS);
        let transform = transform * Affine3A::from_translation(Vec3::Y * QUAY);
        house.build(modeller, palette, dice, &transform);
        at += house.width;
    }
}

impl House {
    fn new(palette: &Palette, dice: &mut Dice) -> Self {
        let width = dice.between(4.8, 7.4);
        let above = dice.pick(&[2u8, 3, 3, 3, 4]);
        let ground = dice.between(3.3, 4.0);
        let first = dice.between(2.9, 3.4);
        // Each floor is lower than the one below it.
        let upper = (0..above).map(|floor| first - 0.15 * f32::from(floor));
        Self {
            width,
            floors: core::iter::once(ground).chain(upper).collect(),
            windows: if width > 6.0 { 3 } else { 2 },
            front: dice.pick(&palette.fronts),
            door: dice.pick(&palette.colours),
            style: dice.pick(&Gable::ALL),
        }
    }

    fn build(
        &self,
        modeller: &mut Modeller,
        palette: &Palette,
        dice: &mut Dice,
        transform: &Affine3A,
    ) {
        let half = 0.5 * self.width;
        let mut bottom = 0.0;
        for (floor, height) in self.floors.iter().enumerate() {
            let top = bottom + height;
            let openings = if floor == 0 {
                self.ground_floor(palette, dice, *height)
            } else {
                self.upper_floor(palette, dice, bottom, *height)
            };
            wall(
                modeller,
                self.front,
                transform,
                [-half, half],
                [bottom, top],
                &openings,
            );
            for opening in &openings {
                opening.fill(modeller, palette, dice, transform);
            }
            bottom = top;
        }
        self.band(modeller, palette, transform, self.floors[0] - 0.2);
        self.body(modeller, palette, transform, bottom);
        self.gable(modeller, palette, dice, transform, bottom);
    }

    /// A door and a large window, of a shop or of a dwelling.
    fn ground_floor(&self, palette: &Palette, dice: &mut Dice, height: f32) -> Vec<Opening> {
        let half = 0.5 * self.width;
        let content = if dice.chance(0.55) {
            Content::Shop(dice.pick(&palette.shops))
        } else if dice.chance(0.5) {
            Content::Room(dice.pick(&palette.rooms))
        } else {
            Content::Dark
        };
        let top = height - 0.65;
        let door = Opening {
            x: [-half + 0.5, -half + 1.55],
            y: [0.15, top],
            content: Content::Door(self.door),
        };
        let window = Opening {
            x: [-half + 2.1, half - 0.5],
            y: [0.75, top],
            content,
        };
        vec![door, window]
    }

    /// Windows side by side; whole floors are out, or at home.
    fn upper_floor(
        &self,
        palette: &Palette,
        dice: &mut Dice,
        bottom: f32,
        height: f32,
    ) -> Vec<Opening> {
        let share = self.width / f32::from(self.windows);
        let half_window = 0.5 * share.min(2.2) - 0.36;
        let at_home = dice.chance(0.62);
        let room = dice.pick(&palette.rooms);
        let window = |k: u16| {
            let middle = (f32::from(k) + 0.5) * share - 0.5 * self.width;
            let content = if at_home && dice.chance(0.8) {
                Content::Room(if dice.chance(0.75) {
                    room
                } else {
                    dice.pick(&palette.rooms)
                })
            } else {
                Content::Dark
            };
            Opening {
                x: [middle - half_window, middle + half_window],
                y: [bottom + 0.75, bottom + height - 0.45],
                content,
            }
        };
        (0..self.windows).map(window).collect()
    }

    /// A course of stone across the front.
    fn band(&self, modeller: &mut Modeller, palette: &Palette, transform: &Affine3A, y: f32) {
        let half = 0.5 * self.width;
        let low = Vec3::new(-half, y, 0.0);
        modeller.block(
            palette.stone,
            transform,
            low,
            Vec3::new(half, y + 0.18, 0.09),
        );
    }

    /// Side walls, back, roof and chimney behind a front of height `top`.
    fn body(&self, modeller: &mut Modeller, palette: &Palette, transform: &Affine3A, top: f32) {
        let half = 0.5 * self.width;
        let ridge = top + self.roof_height();
        let at = |x: f32, y: f32, z: f32| transform.transform_point3(Vec3::new(x, y, z));
        for side in [-1.0, 1.0] {
            let x = side * half;
            let wall = [
                at(x, 0.0, 0.0),
                at(x, 0.0, -DEPTH),
                at(x, top, -DEPTH),
                at(x, top, 0.0),
            ];
            let roof = [
                at(x, top, 0.0),
                at(x, top, -DEPTH),
                at(0.0, ridge, -DEPTH),
                at(0.0, ridge, 0.0),
            ];
            let facing = |q: [Vec3; 4]| {
                if side > 0.0 {
                    q
                } else {
                    [q[3], q[2], q[1], q[0]]
                }
            };
            modeller.quad(self.front, facing(wall));
            modeller.quad(palette.tiles, facing(roof));
        }
        for (z, side) in [(-0.2, 1.0), (-DEPTH, -1.0)] {
            let end = [
                at(-side * half, top, z),
                at(side * half, top, z),
                at(0.0, ridge, z),
            ];
            modeller.triangle(self.front, end);
        }
        let back = [
            at(half, 0.0, -DEPTH),
            at(-half, 0.0, -DEPTH),
            at(-half, top, -DEPTH),
            at(half, top, -DEPTH),
        ];
        modeller.quad(self.front, back);
        let low = Vec3::new(0.25 * self.width, top, -4.0);
        let high = Vec3::new(0.25 * self.width + 0.6, ridge + 0.5, -3.2);
        modeller.block(self.front, transform, low, high);
    }
}
