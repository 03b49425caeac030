use glam::Vec3;
use light_math::float;

use super::place::Place;
use super::rooms::down;
use crate::random::Random;

/// Windows on two facades that face each other; receivers on the road and on the facades.
pub(super) fn canyon(r: &mut Random, place: &mut Place) {
    let width = r.between(8.0, 30.0);
    let storeys = 4 + r.below(12);
    let bays = (place.n() / 2 / (2 * storeys)).max(1) + 1;
    let pitch = r.between(2.0, 4.0);
    let half = [r.between(0.3, 0.8), r.between(0.4, 1.0)];
    let length = bays as f32 * pitch;
    let height = storeys as f32 * 3.2;
    while place.wants_lights() {
        let x = (r.below(bays) as f32 + 0.5) * pitch;
        let z = (r.below(storeys) as f32 + 0.5) * 3.2;
        let power = 10.0 * r.log_uniform(1.5);
        if r.unit() < 0.5 {
            let edges = [Vec3::X * half[0], Vec3::NEG_Z * half[1]];
            place.panel(Vec3::new(x, 0.0, z), edges, power);
        } else {
            let edges = [Vec3::X * half[0], Vec3::Z * half[1]];
            place.panel(Vec3::new(x, width, z), edges, power);
        }
    }
    while place.wants_points() {
        let x = r.unit() * length;
        let kind = r.unit();
        if kind < 0.6 {
            place.point(Vec3::new(x, r.unit() * width, 0.0), Vec3::Z);
        } else if kind < 0.8 {
            place.point(Vec3::new(x, 0.01, r.unit() * height), Vec3::Y);
        } else {
            place.point(Vec3::new(x, width - 0.01, r.unit() * height), Vec3::NEG_Y);
        }
    }
}

/// Small panels all over a wall; receivers before it, from a hand's breadth to twenty metres.
pub(super) fn facade(r: &mut Random, place: &mut Place) {
    let columns = (place.n() / 2).isqrt().max(1) + 1;
    let pitch = r.between(0.1, 0.5);
    let half = pitch * r.between(0.05, 0.4);
    let decades = 2.0 * r.unit();
    let mut cells: Vec<usize> = (0..columns * columns).collect();
    r.shuffle(&mut cells);
    let side = columns as f32 * pitch;
    for i in cells {
        let at = Vec3::new(
            (i % columns) as f32 * pitch,
            0.0,
            (i / columns) as f32 * pitch,
        );
        let edges = [Vec3::X * half, Vec3::Z * half];
        place.panel(at, edges, r.log_uniform(decades));
    }
    while place.wants_points() {
        let away = 0.05 * r.log_uniform(2.6);
        let at = Vec3::new(r.unit() * side, -away, r.unit() * side);
        if r.unit() < 0.4 {
            place.point(Vec3::new(at.x, at.y, 0.0), Vec3::Z);
        } else {
            let n = (r.direction() + Vec3::Y).normalize_or(Vec3::Y);
            place.point(at, n);
        }
    }
}

/// Two spots a car on roads that cross; receivers on the roads and upright beside them.
pub(super) fn head_lamps(r: &mut Random, place: &mut Place) {
    let roads = 2 + r.below(6);
    let cars = (place.n() / 2 / (2 * roads)).max(1);
    let length = cars as f32 * r.between(6.0, 20.0) + 50.0;
    let dip = r.between(0.01, 0.04);
    let apart = length / (roads + 1) as f32;
    let axes = |along_x: bool| {
        if along_x {
            (Vec3::X, Vec3::Y)
        } else {
            (Vec3::Y, Vec3::X)
        }
    };
    while place.wants_lights() {
        let (along, aside) = axes(r.unit() < 0.5);
        let way = if r.unit() < 0.5 { 1.0 } else { -1.0 };
        let lane = (r.below(roads) + 1) as f32 * apart + way * 1.75;
        let car = along * (r.unit() * length) + aside * lane + Vec3::Z * r.between(0.55, 0.9);
        let swerve = r.between(-0.03, 0.03);
        let axis = along * way + aside * swerve - Vec3::Z * dip;
        let (cone, rim) = (r.between(15.0, 25.0), r.between(0.2, 0.8));
        let intensity = 1000.0 * r.between(0.5, 2.0);
        for side in [-0.6, 0.6] {
            let p = car + aside * side;
            place.spot(p, p + axis, cone, rim, intensity);
        }
    }
    while place.wants_points() {
        let (along, aside) = axes(r.unit() < 0.5);
        let lane = (r.below(roads) + 1) as f32 * apart;
        let at = along * (r.unit() * length) + aside * lane;
        if r.unit() < 0.7 {
            place.point(at + aside * r.between(-4.0, 4.0), Vec3::Z);
        } else {
            let n = r.level_direction();
            place.point(
                at + aside * r.between(-8.0, 8.0) + Vec3::Z * r.between(0.2, 2.0),
                n,
            );
        }
    }
}

/// Lamps on the walls of houses, one cone up and one down; receivers on walls and ground.
pub(super) fn wall_lamps(r: &mut Random, place: &mut Place) {
    let pitch = r.between(1.5, 4.0);
    let rows = 2 + r.below(6);
    let height = r.between(1.8, 2.5);
    let per_row = (place.n() / 2 / rows).max(1) + 1;
    let [narrow, wide] = [r.between(8.0, 20.0), r.between(25.0, 60.0)];
    let street = r.between(6.0, 15.0);
    let length = per_row as f32 * pitch;
    while place.wants_lights() {
        let p = Vec3::new(
            r.below(per_row) as f32 * pitch,
            r.below(rows) as f32 * street + r.between(0.08, 0.2),
            height,
        );
        let intensity = 100.0 * r.between(0.5, 1.5);
        let rim = r.between(0.1, 0.6);
        place.spot(p + Vec3::Z * 0.1, p + Vec3::Z, narrow, rim, intensity);
        place.spot(p - Vec3::Z * 0.1, p - Vec3::Z, wide, rim, intensity);
    }
    while place.wants_points() {
        let x = r.unit() * length;
        let y = r.below(rows) as f32 * street;
        if r.unit() < 0.5 {
            let z = float::sqrt(r.unit()) * 3.0 * height;
            place.point(Vec3::new(x, y, z), Vec3::Y);
        } else {
            place.point(Vec3::new(x, y + r.unit() * street, 0.0), Vec3::Z);
        }
    }
}

pub(super) fn street_lamps(r: &mut Random, place: &mut Place) {
    let pitch = r.between(2.0, 30.0);
    let height = pitch * r.between(0.15, 0.4);
    let slope = [0.0, r.between(0.2, 0.7)][r.below(2)];
    let bend = r.between(0.0, 0.3);
    let uneven = r.between(0.0, 0.3);
    let (cone, rim) = (r.between(50.0, 80.0), r.between(0.1, 0.9));
    let panels = r.unit() < 0.3;
    let spacing = if panels { 0.5 * pitch } else { pitch };
    let length = place.n() as f32 * spacing;
    // Where the row is, so far along it.
    let at = |s: f32| {
        let aside = 0.1 * bend * length * float::sin(3.0 * s / length);
        Vec3::new(s, aside, slope * s)
    };
    let mut lamps = 0;
    while place.wants_lights() {
        let s = pitch * (lamps as f32 + uneven * r.unit());
        lamps += 1;
        let p = at(s) + Vec3::Z * height;
        if panels {
            place.panel(p, down(0.02 * pitch, 0.1 * pitch), 10.0);
        } else {
            place.spot(p, p - Vec3::Z, cone, rim, 100.0);
        }
    }
    while place.wants_points() {
        let s = length * r.unit();
        let aside = 0.5 * height * (r.unit() - 0.5);
        let n = Vec3::new(-slope, 0.0, 1.0).normalize();
        place.point(at(s) + Vec3::Y * aside, n);
    }
}
