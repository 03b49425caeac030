use super::camera::camera;
use super::lamps::{Lamps, Spread};
use super::size::count;
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec2, Vec3};
use crate::{Material, MaterialId, Scene};

/// Width of a street from front to front.
const STREET: f32 = 7.0;

/// From the front of a house to its other front.
const DEPTH: f32 = 6.0;

/// From one window to the next, and from one storey to the next.
const BAY: Vec2 = Vec2::new(1.7, 2.9);

/// Half the size of a window.
const PANE: Vec2 = Vec2::new(0.45, 0.65);

/// From a front to its windows.
const GAP: f32 = 0.03;

/// Lamps of one string across a street.
const STRING: usize = 8;

/// A house: its place along the street, how far it leads, and its storeys.
#[derive(Clone, Copy, Debug)]
struct House {
    /// The front toward lower x.
    x: f32,
    z: [f32; 2],
    storeys: u16,
}

/// A window of a front that looks to the side of `sign` along x.
#[derive(Clone, Copy, Debug)]
struct Window {
    center: Vec3,
    sign: f32,
}

/// Rows of houses with gaps between them, and streets between the rows: half of the lamps are
/// windows, a fifth lanterns, the others hang on strings across the streets but that of the camera.
pub(super) fn street(lamps: usize, dice: &mut Dice) -> Scene {
    // Enough houses that a third of the windows are lit.
    let streets = (3..).find(|s| 90 * s * s >= lamps).unwrap_or(3);
    let per_row = 3 * streets + 4;
    let mut modeller = Modeller::default();
    let m = &mut modeller;
    let town = Town::new(m);
    let shape = Lamps::new(m);
    let mut windows = Vec::new();
    let mut length = 0.0f32;
    for row in 0..=streets {
        let x = (STREET + DEPTH) * row as f32;
        let mut z = 0.0;
        for _ in 0..per_row {
            let wide = dice.pick(&[4.0, 5.0, 6.0]) * BAY.x * 0.8 + 0.6;
            let storeys = dice.pick(&[2, 3, 3, 4]);
            let ends = [z, z - wide];
            let house = House {
                x,
                z: ends,
                storeys,
            };
            town.build(m, dice, &house, &mut windows);
            z = ends[1] - if dice.chance(0.4) { 1.8 } else { 0.0 };
        }
        length = length.max(-z);
    }
    let wide = (STREET + DEPTH) * streets as f32 + DEPTH;
    let (low, high) = (
        Vec3::new(-20.0, -0.5, -length - 20.0),
        Vec3::new(wide + 20.0, 0.0, 20.0),
    );
    m.block(town.paving, &Affine3A::IDENTITY, low, high);
    shuffle(dice, &mut windows);
    let lit = (lamps / 2).min(windows.len());
    for (k, window) in windows.iter().enumerate() {
        let axes = [Vec3::NEG_Z * (window.sign * PANE.x), Vec3::Y * PANE.y];
        if k < lit {
            shape.add(m, dice, window.center, axes);
        } else {
            m.quad(town.glass, pane(window.center, axes));
        }
    }
    let lanterns = lamps / 5;
    let hung = lamps - lit - lanterns;
    let part = |of: usize, k: usize, parts: usize| of * (k + 1) / parts - of * k / parts;
    let middle = |street: usize| (STREET + DEPTH) * street as f32 + DEPTH + 0.5 * STREET;
    let own = streets / 2;
    for street in 0..streets {
        let here = part(lanterns, street, streets);
        town.lanterns(m, dice, &shape, [middle(street), length], here);
    }
    let others = (0..streets).filter(|&street| street != own);
    for (k, street) in others.enumerate() {
        let here = part(hung, k, streets - 1);
        town.strings(m, dice, &shape, [middle(street), length], here);
    }
    let middle = middle(own);
    let start = -0.25 * length + 8.0;
    let eye = Vec3::new(middle + 1.2, 1.7, start);
    let target = Vec3::new(middle - 0.8, 2.4, start - 12.0);
    let mut scene = modeller.finish();
    scene.camera = Some(camera(eye, target, 62.0));
    scene
}

/// In any order, each as likely as the others.
fn shuffle<T>(dice: &mut Dice, values: &mut [T]) {
    for end in (1..values.len()).rev() {
        let with = dice.below(end + 1);
        values.swap(end, with);
    }
}

/// The corners of a window between the middles of its edges.
fn pane(center: Vec3, [u, v]: [Vec3; 2]) -> [Vec3; 4] {
    [
        center - u - v,
        center + u - v,
        center + u + v,
        center - u + v,
    ]
}

/// What a town is made of.
struct Town {
    paving: MaterialId,
    fronts: [MaterialId; 4],
    roof: MaterialId,
    glass: MaterialId,
    iron: MaterialId,
}

impl Town {
    fn new(m: &mut Modeller) -> Self {
        let mut matte = |name: &str, r: f32, g: f32, b: f32| {
            m.material(Material::diffuse(name, Vec3::new(r, g, b)))
        };
        Self {
            paving: matte("paving", 0.3, 0.29, 0.27),
            fronts: [
                matte("brick", 0.4, 0.22, 0.16),
                matte("plaster", 0.62, 0.58, 0.5),
                matte("ochre", 0.55, 0.42, 0.24),
                matte("grey", 0.4, 0.4, 0.4),
            ],
            roof: matte("tiles", 0.2, 0.11, 0.09),
            glass: matte("dark glass", 0.04, 0.045, 0.05),
            iron: matte("iron", 0.05, 0.05, 0.05),
        }
    }

    /// A house under a gabled roof; adds the windows of both fronts.
    fn build(&self, m: &mut Modeller, dice: &mut Dice, house: &House, windows: &mut Vec<Window>) {
        let &House {
            x,
            z: [near, far],
            storeys,
        } = house;
        let top = BAY.y * f32::from(storeys) + 0.6;
        let (low, high) = (Vec3::new(x, 0.0, far), Vec3::new(x + DEPTH, top, near));
        m.block(dice.pick(&self.fronts), &Affine3A::IDENTITY, low, high);
        let ridge = top + 0.3 * DEPTH;
        let eaves = |x: f32, z: f32| Vec3::new(x, top, z);
        let crest = |z: f32| Vec3::new(x + 0.5 * DEPTH, ridge, z);
        let right = x + DEPTH;
        m.quad(
            self.roof,
            [eaves(x, far), eaves(x, near), crest(near), crest(far)],
        );
        m.quad(
            self.roof,
            [
                eaves(right, near),
                eaves(right, far),
                crest(far),
                crest(near),
            ],
        );
        m.triangle(self.roof, [eaves(x, near), eaves(right, near), crest(near)]);
        m.triangle(self.roof, [eaves(right, far), eaves(x, far), crest(far)]);
        let bays = count((near - far) / BAY.x - 0.5).max(1);
        for (front, sign) in [(x - GAP, -1.0), (right + GAP, 1.0)] {
            for storey in 0..storeys {
                for bay in 0..bays {
                    let along = (f32::from(bay) + 0.5) / f32::from(bays);
                    let y = BAY.y * f32::from(storey) + 1.7;
                    windows.push(Window {
                        center: Vec3::new(front, y, near + (far - near) * along),
                        sign,
                    });
                }
            }
        }
    }

    /// Lanterns on poles along both sides of a street.
    fn lanterns(
        &self,
        m: &mut Modeller,
        dice: &mut Dice,
        shape: &Lamps,
        [middle, length]: [f32; 2],
        count: usize,
    ) {
        for k in 0..count {
            let side = if k % 2 == 0 { -1.0 } else { 1.0 };
            let z = -length * (k as f32 + dice.between(0.3, 0.7)) / count as f32;
            let foot = Vec3::new(middle + side * (0.5 * STREET - 1.0), 0.0, z);
            let head = foot + Vec3::new(-0.45 * side, 4.2, 0.0);
            let elbow = foot + Vec3::Y * 4.3;
            m.bar(self.iron, [foot, elbow], [0.06, 0.04], 6);
            m.bar(self.iron, [elbow, head + Vec3::Y * 0.06], [0.03, 0.03], 4);
            shape.add_square(m, dice, head, Vec3::NEG_Y, 0.12);
        }
    }

    /// Strings of lamps across a street, from front to front.
    fn strings(
        &self,
        m: &mut Modeller,
        dice: &mut Dice,
        shape: &Lamps,
        [middle, length]: [f32; 2],
        count: usize,
    ) {
        let strings = count.div_ceil(STRING);
        let places = [Vec2::new(-length, 4.6), Vec2::new(-1.0, 6.0)];
        let spread = Spread::new(dice, strings, places);
        for (k, place) in spread.places.into_iter().enumerate() {
            let here = STRING.min(count - k * STRING);
            let at = |t: f32| {
                let sag = 0.7 * (1.0 - t * t);
                Vec3::new(middle + 0.5 * STREET * t, place.y - sag, place.x)
            };
            for piece in 0..6u8 {
                let ends = [piece, piece + 1].map(|k| at(f32::from(k) / 3.0 - 1.0));
                m.bar(self.iron, ends, [0.008, 0.008], 3);
            }
            for lamp in 0..here {
                let t = 1.8 * ((lamp as f32 + 0.5) / here as f32 - 0.5);
                let center = at(t) - Vec3::Y * 0.08;
                let toward = Vec3::new(dice.between(-0.5, 0.5), -1.0, dice.between(-0.5, 0.5));
                shape.add_square(m, dice, center, toward.normalize_or(Vec3::NEG_Y), 0.06);
            }
        }
    }
}
