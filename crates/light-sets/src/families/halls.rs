use glam::Vec3;

use super::place::Place;
use crate::random::Random;

/// Side of a floor on which `n` lamps have `pitch` to each other.
fn side(n: usize, pitch: f32) -> f32 {
    (n as f32).sqrt() * pitch
}

fn on_floor(r: &mut Random, place: &mut Place, side: f32, up: f32) {
    while place.wants_points() {
        let at = Vec3::new(r.unit() * side, r.unit() * side, up * r.unit());
        place.point(at, Vec3::Z);
    }
}

/// Masts around a field, each with many narrow beams; receivers on the field and on spectators.
pub(super) fn stadium(r: &mut Random, place: &mut Place) {
    let masts = 4 + r.below(12);
    let field = Vec3::new(r.between(60.0, 110.0), r.between(40.0, 80.0), 0.0);
    let height = r.between(25.0, 50.0);
    let (narrow, wide) = (r.between(3.0, 6.0), r.between(10.0, 18.0));
    let rim = r.between(0.1, 0.9);
    while place.wants_lights() {
        let turn = core::f32::consts::TAU * r.below(masts) as f32 / masts as f32;
        let (s, c) = light_math::float::sin_cos(turn);
        let mast = field * 0.5 + field * Vec3::new(c, s, 0.0) * 0.8;
        let p = mast + Vec3::new(r.unit() * 4.0, r.unit() * 4.0, height + r.unit() * 4.0);
        let target = field * r.cube();
        place.spot(p, target, r.between(narrow, wide), rim, 1000.0);
    }
    while place.wants_points() {
        let at = field * r.cube();
        if r.unit() < 0.8 {
            place.point(at, Vec3::Z);
        } else {
            let n = (r.level_direction() + Vec3::Z * 0.5).normalize();
            place.point(at + Vec3::Z * r.between(0.5, 2.0), n);
        }
    }
}

/// Spots straight down from one ceiling, of all widths.
pub(super) fn downlights(r: &mut Random, place: &mut Place) {
    let height = r.between(2.4, 5.0);
    let side = side(place.n(), r.between(0.4, 2.0));
    let rim = r.between(0.0, 0.5);
    while place.wants_lights() {
        let p = Vec3::new(r.unit() * side, r.unit() * side, height);
        let cone = r.between(8.0, 50.0);
        place.spot(p, p - Vec3::Z, cone, rim, 100.0 * r.log_uniform(1.0));
    }
    on_floor(r, place, side, 0.8);
}

/// Narrow spots straight down from one ceiling, and a few wide ones between.
pub(super) fn accents(r: &mut Random, place: &mut Place) {
    let height = r.between(2.4, 5.0);
    let side = side(place.n(), r.between(0.3, 1.5));
    let share = r.between(0.01, 0.1);
    let [narrow, wide] = [r.between(5.0, 12.0), r.between(45.0, 70.0)];
    let rim = r.between(0.0, 0.3);
    while place.wants_lights() {
        let p = Vec3::new(r.unit() * side, r.unit() * side, height);
        let cone = if r.unit() < share { wide } else { narrow };
        place.spot(p, p - Vec3::Z, cone, rim, 100.0);
    }
    on_floor(r, place, side, 0.8);
}

/// Spots in a hall, each roughly down, with the given rims.
fn hall(r: &mut Random, place: &mut Place, tilt: f32, rims: [f32; 2]) {
    let (low, high) = (r.between(2.0, 4.0), r.between(4.0, 9.0));
    let side = side(place.n(), r.between(0.5, 3.0));
    let [narrow, wide] = [r.between(8.0, 15.0), r.between(40.0, 75.0)];
    while place.wants_lights() {
        let p = Vec3::new(r.unit() * side, r.unit() * side, r.between(low, high));
        let axis = Vec3::NEG_Z + r.direction() * tilt * r.unit();
        let (cone, rim) = (r.between(narrow, wide), r.between(rims[0], rims[1]));
        place.spot(p, p + axis, cone, rim, 100.0 * r.log_uniform(1.5));
    }
    on_floor(r, place, side, 1.5);
}

/// Spots without a rim.
pub(super) fn hard_spots(r: &mut Random, place: &mut Place) {
    let tilt = r.between(0.2, 3.0);
    hall(r, place, tilt, [0.0, 0.0]);
}

/// Spots with rims of any width.
pub(super) fn soft_spots(r: &mut Random, place: &mut Place) {
    let tilt = r.between(0.2, 1.5);
    hall(r, place, tilt, [0.1, 0.9]);
}
