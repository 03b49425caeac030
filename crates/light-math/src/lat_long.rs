//! The latitude-longitude map between the unit square and the sphere, the usual layout of
//! environment maps.
//!
//! `u` in `[0, 1)` runs along a row, `v` in `[0, 1]` from the top row (+y) to the bottom row (-y).
//! With `t = pi v` and `p = 2 pi u` the direction is `(sin t sin p, cos t, -sin t cos p)`: the
//! middle of the map looks to +z, as that of the equal-area map does.

use core::f32::consts::{FRAC_1_PI, PI, TAU};

use glam::{Vec2, Vec3};

use crate::float::{ONE_MINUS_EPSILON, atan2, sin, sin_cos, sqrt};

/// The unit vector of the point `(u, v)`.
#[inline]
#[must_use]
pub fn direction(uv: Vec2) -> Vec3 {
    let (sin_t, cos_t) = sin_cos(PI * uv.y);
    let (sin_p, cos_p) = sin_cos(TAU * uv.x);
    Vec3::new(sin_t * sin_p, cos_t, -sin_t * cos_p)
}

/// The point `(u, v)` of the direction `d`, of a length from 1e-15 to 1e15; `u` in `[0, 1)`, 0 at
/// the poles.
#[inline]
#[must_use]
pub fn uv(d: Vec3) -> Vec2 {
    let sin_t = sqrt(d.x * d.x + d.z * d.z);
    if sin_t == 0.0 {
        return Vec2::new(0.0, if d.y < 0.0 { 1.0 } else { 0.0 });
    }
    let u = (0.5 * FRAC_1_PI) * atan2(d.x, -d.z);
    let u = if u < 0.0 { u + 1.0 } else { u };
    Vec2::new(u.min(ONE_MINUS_EPSILON), FRAC_1_PI * atan2(sin_t, d.y))
}

/// The solid angle in sr per unit of area of the square at height `v`: `2 pi^2 sin(pi v)`.
#[inline]
#[must_use]
pub fn solid_angle_per_area(v: f32) -> f32 {
    2.0 * PI * PI * sin(PI * v).max(0.0)
}

/// The texel of an image of the given columns and rows at `(x, y)`, which lies at most one image
/// outside.
///
/// Rows close upon themselves; beyond a pole the map goes on half a turn further, downwards again.
#[inline]
#[must_use]
#[expect(
    clippy::cast_sign_loss,
    clippy::cast_possible_wrap,
    reason = "sizes are far below 2^31, wrapped indices are positive"
)]
pub(crate) fn wrap_texel(x: i32, y: i32, size: [u32; 2]) -> (u32, u32) {
    let (columns, rows) = (size[0] as i32, size[1] as i32);
    let (x, y) = if y < 0 {
        (x + columns / 2, -1 - y)
    } else if y >= rows {
        (x + columns / 2, 2 * rows - 1 - y)
    } else {
        (x, y)
    };
    (x.rem_euclid(columns) as u32, y as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn landmarks() {
        let cases = [
            ((0.5, 0.5), Vec3::Z),
            ((0.0, 0.5), Vec3::NEG_Z),
            ((0.25, 0.5), Vec3::X),
            ((0.75, 0.5), Vec3::NEG_X),
            ((0.0, 0.0), Vec3::Y),
            ((0.0, 1.0), Vec3::NEG_Y),
        ];
        for ((u, v), d) in cases {
            assert!(direction(Vec2::new(u, v)).distance(d) < 1e-6, "{u} {v}");
            assert!(uv(d).distance(Vec2::new(u, v)) < 1e-6, "{d}: {}", uv(d));
        }
    }

    #[test]
    fn density_integrates_to_the_sphere() {
        let n = 1000;
        let sum: f64 = (0..n)
            .map(|i| f64::from(solid_angle_per_area((i as f32 + 0.5) / n as f32)))
            .sum();
        assert!(
            (sum / f64::from(n) / (4.0 * core::f64::consts::PI) - 1.0).abs() < 1e-5,
            "4 pi"
        );
    }

    /// The formula of [`direction`] goes on beyond the poles and the ends of rows.
    #[test]
    fn texels_outside_are_those_of_their_directions() {
        for size in [[2, 1], [4, 2], [6, 3], [10, 7]] {
            let extent = Vec2::new(size[0] as f32, size[1] as f32);
            let (columns, rows) = (size[0] as i32, size[1] as i32);
            for (x, y) in (-1..=columns).flat_map(|x| (-1..=rows).map(move |y| (x, y))) {
                let center = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) / extent;
                let expected = uv(direction(center)) * extent;
                let (i, j) = wrap_texel(x, y, size);
                let found = Vec2::new(i as f32 + 0.5, j as f32 + 0.5);
                assert!(found.distance(expected) < 1e-4, "{size:?}: {x}, {y}");
            }
        }
    }

    /// Squares of these lengths neither overflow nor vanish.
    #[test]
    fn lengths_do_not_count() {
        let d = Vec3::new(0.4, 0.5, -0.6);
        for length in [1e-15, 1e15] {
            assert!(uv(d * length).distance(uv(d)) < 1e-6, "{length}");
        }
    }

    proptest! {
        #[test]
        fn maps_are_inverse(u in 0.0f32..1.0, v in 1e-3f32..0.999) {
            let p = Vec2::new(u, v);
            let back = uv(direction(p));
            let du = (back.x - u).abs();
            let is_near = du.min(1.0 - du) < 1e-4 && (back.y - v).abs() < 1e-6;
            prop_assert!(is_near, "{} came back as {}", p, back);
        }

        #[test]
        fn u_stays_below_one(x in -1e-6f32..1e-6, y in -1.0f32..1.0, z in -1.0f32..1.0) {
            let p = uv(Vec3::new(x, y, z));
            prop_assert!((0.0..1.0).contains(&p.x) && (0.0..=1.0).contains(&p.y), "{}", p);
        }
    }
}
