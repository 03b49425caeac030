use super::corners::corners;
use super::gable_style::Gable;
use super::house::House;
use super::palette::Palette;
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec3};

impl House {
    /// Builds the gable on a front of height `top`.
    pub(super) fn gable(
        &self,
        modeller: &mut Modeller,
        palette: &Palette,
        dice: &mut Dice,
        transform: &Affine3A,
        top: f32,
    ) {
        match self.style {
            Gable::Stepped => self.stepped_gable(modeller, palette, dice, transform, top),
            Gable::Necked => self.necked_gable(modeller, palette, dice, transform, top),
            Gable::Pointed => self.pointed_gable(modeller, palette, transform, top),
            Gable::Cornice => self.cornice(modeller, palette, transform, top),
        }
    }

    /// From the top of the front to the ridge of the roof.
    pub(super) fn roof_height(&self) -> f32 {
        match self.style {
            Gable::Stepped | Gable::Necked => 0.52 * self.width,
            Gable::Pointed => 0.6 * self.width,
            Gable::Cornice => 0.3 * self.width,
        }
    }

    /// Steps of brick with a stone on each, and a window under the hoist.
    fn stepped_gable(
        &self,
        modeller: &mut Modeller,
        palette: &Palette,
        dice: &mut Dice,
        transform: &Affine3A,
        top: f32,
    ) {
        const STEPS: u16 = 4;
        let rise = (self.roof_height() + 0.5) / f32::from(STEPS);
        for k in 0..STEPS {
            let half = 0.5 * self.width * (1.0 - f32::from(k) / f32::from(STEPS)) - 0.1;
            let y = top + rise * f32::from(k);
            let (low, high) = (Vec3::new(-half, y, -0.4), Vec3::new(half, y + rise, 0.0));
            modeller.block(self.front, transform, low, high);
            for side in [-1.0, 1.0] {
                let outer = side * half;
                let inner = outer - side * 0.125 * self.width;
                let low = Vec3::new(outer.min(inner) - 0.04, y + rise, -0.44);
                let high = Vec3::new(outer.max(inner) + 0.04, y + rise + 0.12, 0.04);
                modeller.block(palette.stone, transform, low, high);
            }
        }
        self.attic(modeller, palette, dice, transform, top);
    }

    /// A tall narrow middle with a small pediment, and shoulders on both sides.
    fn necked_gable(
        &self,
        modeller: &mut Modeller,
        palette: &Palette,
        dice: &mut Dice,
        transform: &Affine3A,
        top: f32,
    ) {
        let half = 0.26 * self.width;
        let height = self.roof_height() + 0.3;
        let (low, high) = (
            Vec3::new(-half, top, -0.4),
            Vec3::new(half, top + height, 0.0),
        );
        modeller.block(self.front, transform, low, high);
        for side in [-1.0f32, 1.0] {
            let (a, b) = (side * half, side * 0.48 * self.width);
            let low = Vec3::new(a.min(b), top, -0.3);
            let high = Vec3::new(a.max(b), top + 0.42 * height, -0.05);
            modeller.block(palette.stone, transform, low, high);
        }
        let cap = Vec3::new(half + 0.15, top + height + 0.15, 0.12);
        let low = Vec3::new(-half - 0.15, top + height, -0.45);
        modeller.block(palette.stone, transform, low, cap);
        let at = |x: f32, y: f32, z: f32| transform.transform_point3(Vec3::new(x, y, z));
        let y = cap.y;
        let front = [at(-half, y, 0.0), at(half, y, 0.0), at(0.0, y + 0.6, 0.0)];
        let back = [
            at(half, y, -0.3),
            at(-half, y, -0.3),
            at(0.0, y + 0.6, -0.3),
        ];
        modeller.triangle(palette.stone, front);
        modeller.triangle(palette.stone, back);
        modeller.quad(palette.stone, [front[1], back[0], back[2], front[2]]);
        modeller.quad(palette.stone, [back[1], front[0], front[2], back[2]]);
        self.attic(modeller, palette, dice, transform, top);
    }

    /// A plain triangle with a coping of stone.
    fn pointed_gable(
        &self,
        modeller: &mut Modeller,
        palette: &Palette,
        transform: &Affine3A,
        top: f32,
    ) {
        let half = 0.5 * self.width;
        let ridge = top + self.roof_height();
        let at = |x: f32, y: f32, z: f32| transform.transform_point3(Vec3::new(x, y, z));
        let front = [at(-half, top, 0.0), at(half, top, 0.0), at(0.0, ridge, 0.0)];
        modeller.triangle(self.front, front);
        for side in [-1.0, 1.0] {
            let ends = [at(side * half, top, -0.05), at(0.0, ridge + 0.1, -0.05)];
            modeller.bar(palette.stone, ends, [0.16, 0.16], 4);
        }
        self.hoist(modeller, palette, transform, ridge - 0.7);
    }

    /// A straight cornice, carried by brackets.
    fn cornice(&self, modeller: &mut Modeller, palette: &Palette, transform: &Affine3A, top: f32) {
        let half = 0.5 * self.width;
        let low = Vec3::new(-half, top - 0.1, -0.3);
        let high = Vec3::new(half, top + 0.25, 0.35);
        modeller.block(palette.paint, transform, low, high);
        for k in 0..9u8 {
            let x = half * (f32::from(k) / 4.5 - 0.89);
            let low = Vec3::new(x - 0.06, top - 0.35, 0.0);
            let high = Vec3::new(x + 0.06, top - 0.1, 0.25);
            modeller.block(palette.paint, transform, low, high);
        }
    }

    /// A window in the gable, before its wall, and the beam by which furniture goes up.
    fn attic(
        &self,
        modeller: &mut Modeller,
        palette: &Palette,
        dice: &mut Dice,
        transform: &Affine3A,
        top: f32,
    ) {
        let half = 0.42;
        let (y0, y1) = (top + 0.35, top + 1.5);
        let pane = if dice.chance(0.4) {
            dice.pick(&palette.rooms)[1]
        } else {
            palette.dark_glass
        };
        let [min, max] = corners([-half, half], [y0, y1]);
        modeller.panel(pane, transform, min, max, 0.03);
        let frame = [
            ([-half - 0.08, -half], [y0, y1]),
            ([half, half + 0.08], [y0, y1]),
            ([-0.03, 0.03], [y0, y1]),
            ([-half - 0.08, half + 0.08], [y0 - 0.08, y0]),
            ([-half - 0.08, half + 0.08], [y1, y1 + 0.08]),
        ];
        for (x, y) in frame {
            let low = Vec3::new(x[0], y[0], 0.0);
            modeller.block(palette.paint, transform, low, Vec3::new(x[1], y[1], 0.08));
        }
        self.hoist(modeller, palette, transform, y1 + 0.35);
    }

    fn hoist(&self, modeller: &mut Modeller, palette: &Palette, transform: &Affine3A, y: f32) {
        let low = Vec3::new(-0.07, y, -0.2);
        modeller.block(palette.iron, transform, low, Vec3::new(0.07, y + 0.16, 0.9));
    }
}
