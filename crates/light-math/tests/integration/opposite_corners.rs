//! Triangles with two corners in nearly opposite directions, against double precision.

use light_math::glam::{Vec2, Vec3};
use light_math::warp::SphericalTriangle;
use light_testkit::Rng;

use crate::real3::{Real3, cross, dot, length, minus};

const EPSILON: f64 = f32::EPSILON as f64;

fn solid_angle([a, b, c]: [Real3; 3]) -> f64 {
    let [la, lb, lc] = [a, b, c].map(length);
    let below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    2.0 * f64::atan2(dot(a, cross(b, c)).abs(), below)
}

/// Two corners that are `off` from opposite, and a third one at 45 degrees or more from both.
fn corners(rng: &mut Rng, off: f32) -> [Vec3; 3] {
    let mut unit = || (Vec3::new(rng.f32(), rng.f32(), rng.f32()) * 2.0 - 1.0).normalize();
    let (a, across, third) = (unit(), unit(), unit());
    let [across, third] = [across, third].map(|v| v.reject_from(a).normalize());
    let third = third + a * (2.0 * rng.f32() - 1.0);
    let mut length = || (3.0 * rng.f32() - 1.5).exp();
    let (a, b) = (a * length(), (across * off - a) * length());
    [a, b, third * length()]
}

/// The nearest distance of a corner over that of the plane: how far a rounding of the corners may
/// move the solid angle.
fn condition(v: [Vec3; 3]) -> f64 {
    let r = v.map(|v| minus(v, Vec3::ZERO));
    let normal = cross(minus(v[1], v[0]), minus(v[2], v[0]));
    let nearest = r.map(length).into_iter().fold(f64::MAX, f64::min);
    nearest * length(normal) / dot(r[0], normal).abs()
}

/// The `u.x` of a place in double precision, and by how much four roundings of it move that.
fn invert(v: [Vec3; 3], b: Vec3) -> [f64; 2] {
    let [r0, r1, r2] = v.map(|v| minus(v, Vec3::ZERO));
    let cut = f64::from(b.z) / (f64::from(b.x) + f64::from(b.z));
    let share = |cut: f64| {
        let end = core::array::from_fn(|i| r0[i] + (r2[i] - r0[i]) * cut);
        solid_angle([r0, r1, end]) / solid_angle([r0, r1, r2])
    };
    let moved = [-4.0, 4.0].map(|by| (share(cut + by * EPSILON) - share(cut)).abs());
    [share(cut), moved[0].max(moved[1])]
}

/// For each angle and corner, all triangles whose plane is not much nearer than the edge between
/// the opposite corners.
fn for_all(mut test: impl FnMut(&mut Rng, f32, usize, [Vec3; 3])) {
    let mut rng = Rng::new(7);
    for off in [0.1, 0.03, 0.01, 0.003, 0.001] {
        for first in 0..3 {
            for _ in 0..2000 {
                let mut v = corners(&mut rng, off);
                v.rotate_right(first);
                if condition(v) * f64::from(off) < 10.0 {
                    test(&mut rng, off, first, v);
                }
            }
        }
    }
}

#[test]
fn solid_angles_keep_their_digits() {
    for_all(|_, off, _, v| {
        let seen = SphericalTriangle::new(v, Vec3::ZERO).expect("a solid angle");
        let exact = solid_angle(v.map(|v| minus(v, Vec3::ZERO)));
        let error = (f64::from(seen.solid_angle()) / exact - 1.0).abs() / EPSILON;
        assert!(error < 32.0, "{v:?}, off {off}: {error} roundings");
    });
}

/// The first corner is opposite to one of the others. From the second, every cut is near the third
/// if that one is opposite.
#[test]
fn areas_are_cut_where_they_should_be() {
    let mut sums = std::collections::HashMap::<_, [f64; 2]>::new();
    for_all(|rng, off, first, v| {
        if first == 1 {
            return;
        }
        let seen = SphericalTriangle::new(v, Vec3::ZERO).expect("a solid angle");
        let u = Vec2::new(rng.f32(), 0.5);
        let [x, moved] = invert(v, seen.sample(u));
        let error = ((x - f64::from(u.x)).abs() - moved).max(0.0) / EPSILON;
        assert!(error < 128.0, "{v:?}, off {off}, {u}: {error} roundings");
        let sum = sums.entry((first, off.to_bits())).or_default();
        *sum = [sum[0] + error, sum[1] + 1.0];
    });
    for (key, [error, n]) in sums {
        let mean = error / n;
        assert!(n > 1000.0 && mean < 0.5, "{key:?}: {mean} roundings");
    }
}
