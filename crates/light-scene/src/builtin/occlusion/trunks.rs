use super::camera::camera;
use super::lamps::{Lamps, Spread};
use super::size::{count, growth};
use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Vec2, Vec3};
use crate::{Material, Scene};

/// Side of the forest of a hundred lamps.
const SIDE: f32 = 30.0;

/// From one trunk to the next, about.
const CELL: f32 = 1.4;

/// The camera, and how far from it the first trunks are.
const EYE: Vec3 = Vec3::new(0.0, 1.7, 7.0);
const CLEARING: f32 = 2.2;

/// How far a lamp is from the bark of a trunk, at least.
const CLEAR: f32 = 0.25;

/// Lamps at all heights below three metres among the trunks of a forest.
pub(super) fn trunks(lamps: usize, dice: &mut Dice) -> Scene {
    let side = SIDE * growth(lamps, 0.3);
    let half = Vec2::splat(0.5 * side);
    let mut modeller = Modeller::default();
    let m = &mut modeller;
    let earth = m.material(Material::diffuse("earth", Vec3::new(0.32, 0.27, 0.2)));
    let bark = m.material(Material::diffuse("bark", Vec3::new(0.36, 0.27, 0.2)));
    let shape = Lamps::new(m);
    let far = side;
    let ground = [(-far, far), (far, far), (far, -far), (-far, -far)];
    m.quad(earth, ground.map(|(x, z)| Vec3::new(x, 0.0, z)));
    let across = usize::from(count(side / CELL));
    let mut forest = Forest {
        across,
        cell: side / across as f32,
        trunks: Vec::with_capacity(across * across),
    };
    for k in 0..across * across {
        let corner = Vec2::new((k % across) as f32, (k / across) as f32);
        let jitter = Vec2::new(dice.between(0.05, 0.95), dice.between(0.05, 0.95));
        let foot = (corner + jitter) * forest.cell - half;
        let radius = dice.between(0.12, 0.35);
        let [a, b] = [foot, foot + dice.between(-0.03, 0.03)];
        let ends = [Vec3::new(a.x, 0.0, a.y), Vec3::new(b.x, 14.0, b.y)];
        if foot.distance(Vec2::new(EYE.x, EYE.z)) > CLEARING {
            m.bar(bark, ends, [radius, 0.8 * radius], 9);
        }
        forest.trunks.push((foot, radius));
    }
    let spread = Spread::new(dice, lamps, [-half, half]);
    for place in spread.places {
        let place = forest.clear(place, half);
        let turn = dice.between(0.0, core::f32::consts::TAU);
        let up = dice.between(-0.5, 0.3);
        let toward = Vec3::new(turn.cos(), up, turn.sin()).normalize_or(Vec3::X);
        let center = Vec3::new(place.x, dice.between(0.5, 3.0), place.y);
        let half_lamp = dice.between(0.05, 0.1);
        shape.add_square(m, dice, center, toward, half_lamp);
    }
    let mut scene = modeller.finish();
    scene.camera = Some(camera(EYE, Vec3::new(0.0, 1.1, 0.0), 60.0));
    scene
}

/// The trunks, one for each cell of a square grid around the origin.
struct Forest {
    across: usize,
    cell: f32,
    trunks: Vec<(Vec2, f32)>,
}

impl Forest {
    /// The place, or one nearby that is in no trunk and not before its bark.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates at the first cell"
    )]
    fn clear(&self, place: Vec2, half: Vec2) -> Vec2 {
        let cell = (place + half) / self.cell;
        let around = |c: f32| (c as usize).saturating_sub(1)..(c as usize + 2).min(self.across);
        let mut at = place;
        // Away from one trunk may be toward another.
        for _ in 0..16 {
            let near = around(cell.y)
                .flat_map(|y| around(cell.x).map(move |x| y * self.across + x))
                .map(|k| self.trunks[k])
                .find(|&(foot, radius)| at.distance(foot) < radius + CLEAR);
            let Some((foot, radius)) = near else { break };
            let way = (at - foot).normalize_or(Vec2::X);
            at = foot + way * (radius + CLEAR * 1.01);
        }
        at
    }
}
