use super::corners::corners;
use super::palette::Palette;
use crate::MaterialId;
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec3};

/// How deep the panes lie behind the front, in metres.
const DEPTH: f32 = 0.2;

/// An opening in a front, in the front's own plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Opening {
    /// From left to right.
    pub(super) x: [f32; 2],
    /// From bottom to top.
    pub(super) y: [f32; 2],
    pub(super) content: Content,
}

/// What an opening holds.
#[derive(Clone, Copy, Debug)]
pub(super) enum Content {
    Dark,
    /// A lit room, its bright, middling and dim panes.
    Room([MaterialId; 3]),
    Shop([MaterialId; 3]),
    Door(MaterialId),
}

impl Opening {
    /// Builds what fills the opening; `transform` is the front's.
    pub(super) fn fill(
        &self,
        modeller: &mut Modeller,
        palette: &Palette,
        dice: &mut Dice,
        transform: &Affine3A,
    ) {
        self.reveal(modeller, palette.paint, transform);
        match self.content {
            Content::Dark => {
                self.panes(modeller, transform, [1, 1], |_, _| palette.dark_glass);
                self.bars(modeller, palette, transform, [2, 3]);
            }
            Content::Room(panes) => {
                let drawn = dice.chance(0.35);
                let columns = if self.x[1] - self.x[0] > 2.0 { 4 } else { 2 };
                self.panes(modeller, transform, [columns, 3], |_, row| {
                    // Lamps hang high, and furniture darkens the lower panes.
                    panes[if row == 0 { 2 } else { dice.pick(&[0, 0, 1]) }]
                });
                self.bars(modeller, palette, transform, [columns, 3]);
                if drawn {
                    self.curtains(modeller, palette, transform);
                }
            }
            Content::Shop(panes) => {
                self.panes(modeller, transform, [4, 3], |_, row| {
                    panes[if row == 2 { 0 } else { dice.pick(&[0, 1]) }]
                });
                self.bars(modeller, palette, transform, [4, 1]);
                self.goods(modeller, palette, dice, transform);
            }
            Content::Door(leaf) => {
                let light = self.y[1] - 0.45;
                let [min, max] = corners(self.x, [self.y[0], light]);
                modeller.panel(leaf, transform, min, max, -DEPTH);
                let [min, max] = corners(self.x, [light, self.y[1]]);
                let above = dice.pick(&palette.rooms)[1];
                modeller.panel(above, transform, min, max, -DEPTH);
                let low = Vec3::new(self.x[0], light - 0.04, -DEPTH);
                let high = Vec3::new(self.x[1], light + 0.04, -DEPTH + 0.06);
                modeller.block(palette.paint, transform, low, high);
            }
        }
        if !matches!(self.content, Content::Door(_)) {
            self.sill(modeller, palette, transform);
        }
    }

    /// The four sides of the opening.
    fn reveal(&self, modeller: &mut Modeller, material: MaterialId, transform: &Affine3A) {
        let ([x0, x1], [y0, y1]) = (self.x, self.y);
        let around = [(x0, y0), (x0, y1), (x1, y1), (x1, y0), (x0, y0)];
        let at = |(x, y): (f32, f32), z: f32| transform.transform_point3(Vec3::new(x, y, z));
        for edge in around.windows(2) {
            let (a, b) = (edge[0], edge[1]);
            let corners = [at(a, 0.0), at(a, -DEPTH), at(b, -DEPTH), at(b, 0.0)];
            modeller.quad(material, corners);
        }
    }

    /// Panes in columns and rows; row 0 is the lowest.
    fn panes(
        &self,
        modeller: &mut Modeller,
        transform: &Affine3A,
        [columns, rows]: [u16; 2],
        mut material: impl FnMut(u16, u16) -> MaterialId,
    ) {
        let cut = |ends: [f32; 2], k: u16, n: u16| {
            let t = f32::from(k) / f32::from(n);
            ends[0] + (ends[1] - ends[0]) * t
        };
        for row in 0..rows {
            for column in 0..columns {
                let x = [column, column + 1].map(|k| cut(self.x, k, columns));
                let y = [row, row + 1].map(|k| cut(self.y, k, rows));
                let [min, max] = corners(x, y);
                modeller.panel(material(column, row), transform, min, max, -DEPTH);
            }
        }
    }

    /// The frame, and the bars between panes.
    fn bars(
        &self,
        modeller: &mut Modeller,
        palette: &Palette,
        transform: &Affine3A,
        [columns, rows]: [u16; 2],
    ) {
        const HALF: f32 = 0.03;
        let ([x0, x1], [y0, y1]) = (self.x, self.y);
        let mut bar = |x: [f32; 2], y: [f32; 2]| {
            let low = Vec3::new(x[0], y[0], -DEPTH);
            let high = Vec3::new(x[1], y[1], -DEPTH + 0.06);
            modeller.block(palette.paint, transform, low, high);
        };
        for column in 0..=columns {
            let x = x0 + (x1 - x0) * f32::from(column) / f32::from(columns);
            bar([(x - HALF).max(x0), (x + HALF).min(x1)], [y0, y1]);
        }
        for row in 0..=rows {
            let y = y0 + (y1 - y0) * f32::from(row) / f32::from(rows);
            bar([x0, x1], [(y - HALF).max(y0), (y + HALF).min(y1)]);
        }
    }

    /// A curtain on either side, before the panes.
    fn curtains(&self, modeller: &mut Modeller, palette: &Palette, transform: &Affine3A) {
        let width = 0.22 * (self.x[1] - self.x[0]);
        let sides = [
            [self.x[0], self.x[0] + width],
            [self.x[1] - width, self.x[1]],
        ];
        for x in sides {
            let [min, max] = corners(x, self.y);
            modeller.panel(palette.curtain, transform, min, max, -DEPTH + 0.03);
        }
    }

    /// What a shop shows, dark before its light.
    fn goods(
        &self,
        modeller: &mut Modeller,
        palette: &Palette,
        dice: &mut Dice,
        transform: &Affine3A,
    ) {
        let mut x = self.x[0] + 0.1;
        while x < self.x[1] - 0.25 {
            let width = dice.between(0.06, 0.22);
            let height = dice.between(0.1, 0.55);
            let low = Vec3::new(x, self.y[0], -DEPTH + 0.01);
            let high = Vec3::new(x + width, self.y[0] + height, -DEPTH + 0.05);
            let material = dice.pick(&palette.colours);
            modeller.block(material, transform, low, high);
            x += width + dice.between(0.02, 0.25);
        }
    }

    fn sill(&self, modeller: &mut Modeller, palette: &Palette, transform: &Affine3A) {
        let low = Vec3::new(self.x[0] - 0.08, self.y[0] - 0.1, -DEPTH + 0.02);
        let high = Vec3::new(self.x[1] + 0.08, self.y[0], 0.1);
        modeller.block(palette.stone, transform, low, high);
    }
}
