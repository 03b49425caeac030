use glam::Vec3;

use super::place::Place;
use crate::random::Random;

/// Half edges of a panel that shines down.
pub(super) fn down(half_x: f32, half_y: f32) -> [Vec3; 2] {
    [Vec3::X * half_x, Vec3::NEG_Y * half_y]
}

/// Panels of one room, equal or over some decades of power.
pub(super) fn offices(r: &mut Random, place: &mut Place) {
    let pitch = r.between(1.5, 3.0);
    let height = r.between(2.5, 4.0);
    let half = r.between(0.15, 0.45);
    let decades = if r.unit() < 0.5 { 0.0 } else { 4.0 * r.unit() };
    let per_side = (place.n() / 2).isqrt().max(1) + 1;
    let mut panels: Vec<usize> = (0..per_side * per_side).collect();
    r.shuffle(&mut panels);
    for i in panels {
        let at = Vec3::new((i % per_side) as f32, (i / per_side) as f32, 0.0) * pitch;
        let power = 40.0 * r.log_uniform(decades);
        place.panel(at + Vec3::Z * height, down(half, half), power);
    }
    let side = per_side as f32 * pitch;
    while place.wants_points() {
        let at = Vec3::new(r.unit() * side, r.unit() * side, 0.0);
        if r.unit() < 0.7 {
            place.point(at + Vec3::Z * r.between(0.0, 0.8), Vec3::Z);
        } else {
            let n = r.level_direction();
            place.point(at + Vec3::Z * r.between(0.1, height - 0.1), n);
        }
    }
}

/// Lamps under the ceiling of each storey, facing down; receivers on floors and desks.
pub(super) fn storeys(r: &mut Random, place: &mut Place) {
    let count = 5 + r.below(20);
    let height = r.between(2.8, 4.0);
    let below = r.between(0.02, 0.4);
    let half = [r.between(0.03, 0.6), r.between(0.03, 0.3)];
    let lamps = (place.n() / 2).div_ceil(count).max(1);
    let side = r.between(1.5, 3.0) * (lamps as f32).sqrt();
    while place.wants_lights() {
        let storey = r.below(count) as f32;
        let z = (storey + 1.0) * height - below;
        let at = Vec3::new(r.unit() * side, r.unit() * side, z);
        let power = 30.0 * r.between(0.5, 1.5);
        place.panel(at, down(half[0], half[1]), power);
    }
    while place.wants_points() {
        let storey = r.below(count) as f32;
        let up = if r.unit() < 0.5 { 0.0 } else { 0.75 };
        let at = Vec3::new(r.unit() * side, r.unit() * side, storey * height + up);
        place.point(at, Vec3::Z);
    }
}

/// Racks in rows, with a strip under the front edge of each board; receivers on boards and fronts.
pub(super) fn shelves(r: &mut Random, place: &mut Place) {
    let boards = 4 + r.below(5);
    let gap = r.between(0.25, 0.6);
    let depth = r.between(0.3, 0.6);
    let aisle = r.between(1.2, 2.5);
    let piece = r.between(0.3, 1.0);
    let rows = ((place.n() / 2 / boards).isqrt() / 2).max(1);
    let length = place.n() as f32 / (2 * boards * rows) as f32 * piece + piece;
    let y = |row: usize| row as f32 * (depth + aisle);
    while place.wants_lights() {
        let (row, board) = (r.below(rows), r.below(boards));
        let x = (r.unit() * length / piece).floor() * piece;
        let z = (board + 1) as f32 * gap - 0.02;
        let at = Vec3::new(x, y(row) + 0.05, z);
        place.panel(at, down(0.45 * piece, 0.01), 5.0 * r.between(0.7, 1.3));
    }
    while place.wants_points() {
        let (row, board) = (r.below(rows), r.below(boards));
        let x = r.unit() * length;
        let z = board as f32 * gap;
        if r.unit() < 0.6 {
            let at = Vec3::new(x, y(row) + r.unit() * depth, z + r.between(0.0, 0.6) * gap);
            place.point(at, Vec3::Z);
        } else {
            let at = Vec3::new(x, y(row) + depth, z + r.unit() * gap);
            place.point(at, Vec3::NEG_Y);
        }
    }
}

/// Flights of stairs: panels on the risers and under the nosings; receivers on treads.
pub(super) fn stairs(r: &mut Random, place: &mut Place) {
    let (rise, tread) = (r.between(0.14, 0.2), r.between(0.25, 0.35));
    let steps = 12 + r.below(12);
    let width = r.between(1.0, 3.0);
    let per_step = 2 + r.below(6);
    let flights = (place.n() / (4 * steps * per_step)).max(1) + 1;
    let half = 0.4 * width / per_step as f32;
    let corner = |flight: usize, step: usize| {
        let across = (flight % 8) as f32 * (width + 2.0);
        let along = (flight / 8) as f32 * (steps as f32 * tread + 3.0);
        Vec3::new(across, along + step as f32 * tread, step as f32 * rise)
    };
    while place.wants_lights() {
        let at = corner(r.below(flights), r.below(steps));
        let x = (r.below(per_step) as f32 + 0.5) * width / per_step as f32;
        if r.unit() < 0.5 {
            // On the riser, toward who comes up.
            let center = at + Vec3::new(x, 0.0, 0.5 * rise);
            place.panel(center, [Vec3::X * half, Vec3::Z * 0.01], 2.0);
        } else {
            let center = at + Vec3::new(x, -0.02, 0.95 * rise);
            place.panel(center, down(half, 0.01), 2.0);
        }
    }
    while place.wants_points() {
        let at = corner(r.below(flights), r.below(steps));
        let on = Vec3::new(r.unit() * width, r.unit() * tread, 0.0);
        place.point(at + on, Vec3::Z);
    }
}

/// Rows that rise backward, each with small lights at its foot; receivers on the rows, on backs of
/// seats and on the field.
pub(super) fn tribune(r: &mut Random, place: &mut Place) {
    let rows = 20 + r.below(60);
    let (rise, depth) = (r.between(0.2, 0.6), r.between(0.7, 1.0));
    let per_row = (place.n() / 2 / rows).max(1) + 1;
    let pitch = r.between(0.5, 2.0);
    let length = per_row as f32 * pitch;
    while place.wants_lights() {
        let row = r.below(rows) as f32;
        let x = r.below(per_row) as f32 * pitch;
        let at = Vec3::new(x, row * depth, row * rise + 0.1);
        place.panel(at, [Vec3::X * 0.05, Vec3::Z * 0.02], r.between(0.5, 1.5));
    }
    while place.wants_points() {
        let row = r.below(rows) as f32;
        let x = r.unit() * length;
        let kind = r.unit();
        if kind < 0.5 {
            let back = r.unit() * depth;
            place.point(
                Vec3::new(x, row * depth - back, (row - 1.0) * rise),
                Vec3::Z,
            );
        } else if kind < 0.8 {
            place.point(Vec3::new(x, row * depth - 0.3, row * rise + 0.2), Vec3::Y);
        } else {
            place.point(Vec3::new(x, -30.0 * r.unit(), 0.0), Vec3::Z);
        }
    }
}
