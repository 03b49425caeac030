use super::camera::camera;
use super::lamps::{Lamps, Spread};
use super::size::{count, growth};
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Mat3A, Vec2, Vec3, Vec3A};
use crate::{Material, MaterialId, Scene};

/// Half the side of a box.
const HALF: f32 = 0.2;

/// Side of the square in plan that one box has for itself. A box of any turn fits into half of it.
const CELL: f32 = 1.4;

/// From one layer of boxes to the next.
const LAYER: f32 = 0.95;

/// Boxes in the air over a floor, each open to one side or downward, with a lamp at its bottom.
pub(super) fn boxes(lamps: usize, dice: &mut Dice) -> Scene {
    let layers = usize::from(count(growth(lamps, 0.22)));
    let side = CELL * (lamps.div_ceil(layers) as f32).sqrt().ceil();
    let mut modeller = Modeller::default();
    let m = &mut modeller;
    let floor = m.material(Material::diffuse("floor", Vec3::new(0.5, 0.47, 0.43)));
    let card = m.material(Material::diffuse("card", Vec3::new(0.55, 0.44, 0.3)));
    let shape = Lamps::new(m);
    let far = 0.5 * side + 6.0;
    let ground = [(-far, far), (far, far), (far, -far), (-far, -far)];
    m.quad(floor, ground.map(|(x, z)| Vec3::new(x, 0.0, z)));
    let half = Vec2::splat(0.5 * side);
    for layer in 0..layers {
        let here = lamps * (layer + 1) / layers - lamps * layer / layers;
        for place in Spread::new(dice, here, [-half, half]).places {
            let height = 1.0 + LAYER * layer as f32 + dice.between(-0.12, 0.12);
            let center = Vec3::new(place.x, height, place.y);
            let turn = dice.between(0.0, core::f32::consts::TAU);
            let down = dice.between(-0.3, 0.5);
            let toward = Vec3::new(turn.cos(), -down, turn.sin()).normalize_or(Vec3::X);
            open_box(m, card, center, toward);
            let size = dice.between(0.06, 0.1);
            let bottom = center - toward * (HALF - 0.02);
            shape.add_square(m, dice, bottom, toward, size);
        }
    }
    let mut scene = modeller.finish();
    scene.camera = Some(camera(
        Vec3::new(1.0, 2.3, 6.8),
        Vec3::new(-0.2, 0.4, 0.0),
        60.0,
    ));
    scene
}

/// A box without lid, open to the side of `toward`.
fn open_box(m: &mut Modeller, card: MaterialId, center: Vec3, toward: Vec3) {
    let (u, v) = toward.any_orthonormal_pair();
    let at = Affine3A {
        matrix3: Mat3A::from_cols(Vec3A::from(u), Vec3A::from(v), Vec3A::from(toward)),
        translation: Vec3A::from(center),
    };
    let corner = |x: f32, y: f32, z: f32| at.transform_point3(Vec3::new(x, y, z) * HALF);
    let rim = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    for k in 0..4 {
        let ((ax, ay), (bx, by)) = (rim[k], rim[(k + 1) % 4]);
        let side = [
            corner(ax, ay, -1.0),
            corner(bx, by, -1.0),
            corner(bx, by, 1.0),
            corner(ax, ay, 1.0),
        ];
        m.quad(card, side);
    }
    let mut bottom = rim.map(|(x, y)| corner(x, y, -1.0));
    bottom.reverse();
    m.quad(card, bottom);
}
