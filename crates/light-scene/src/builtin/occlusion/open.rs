use super::camera::camera;
use super::lamps::{Lamps, Spread};
use super::size::growth;
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Vec2, Vec3};
use crate::{Material, Scene};

/// Side of the field of a hundred lamps.
const SIDE: f32 = 30.0;

/// Lamps over a field, which look down or to the side.
pub(super) fn open(lamps: usize, dice: &mut Dice) -> Scene {
    let side = SIDE * growth(lamps, 0.3);
    let half = Vec2::splat(0.5 * side);
    let mut modeller = Modeller::default();
    let m = &mut modeller;
    let grass = m.material(Material::diffuse("grass", Vec3::new(0.3, 0.36, 0.2)));
    let shape = Lamps::new(m);
    let ground = [(-side, side), (side, side), (side, -side), (-side, -side)];
    m.quad(grass, ground.map(|(x, z)| Vec3::new(x, 0.0, z)));
    let spread = Spread::new(dice, lamps, [-half, half]);
    for place in spread.places {
        let turn = dice.between(0.0, core::f32::consts::TAU);
        let down = dice.between(0.1, 2.0);
        let toward = Vec3::new(turn.cos(), -down, turn.sin()).normalize_or(Vec3::X);
        let center = Vec3::new(place.x, dice.between(0.4, 2.5), place.y);
        shape.add_square(m, dice, center, toward, spread.half);
    }
    let eye = Vec3::new(0.5, 3.0, 8.0);
    let mut scene = modeller.finish();
    scene.camera = Some(camera(eye, Vec3::new(0.0, 0.4, 0.0), 60.0));
    scene
}
