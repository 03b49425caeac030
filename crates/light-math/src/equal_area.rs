//! The equal-area map between the unit square and the sphere.
//!
//! Equal areas of the square are equal solid angles (`4 pi` for all of it). The centre of the
//! square is +z, the corners are all -z, the inscribed diamond is the equator. Neighbours on the
//! square are neighbours on the sphere, and so are, by [`wrap`], points on both sides of an edge.
//!
//! # Source
//! `[Clarberg2008]`, section 2; edges as in `[PBRT4]`, section 3.8.3.

use core::f32::consts::{FRAC_2_PI, FRAC_PI_4};

use glam::{Vec2, Vec3};

use crate::float::{atan, sin_cos, sqrt};

/// The unit vector of the point `p` in `[0, 1]^2`.
#[inline]
#[must_use]
pub fn square_to_sphere(p: Vec2) -> Vec3 {
    let uv = 2.0 * p - 1.0;
    let abs = uv.abs();

    // Radius of the diamond through the point, on the disk of the hemisphere.
    let signed_distance = 1.0 - (abs.x + abs.y);
    let r = 1.0 - signed_distance.abs();
    let turn = if r == 0.0 {
        1.0
    } else {
        (abs.y - abs.x) / r + 1.0
    };
    let (sin_phi, cos_phi) = sin_cos(turn * FRAC_PI_4);

    let z = (1.0 - r * r).copysign(signed_distance);
    let sin_theta = r * sqrt(2.0 - r * r);
    Vec3::new(
        cos_phi.copysign(uv.x) * sin_theta,
        sin_phi.copysign(uv.y) * sin_theta,
        z,
    )
}

/// The point in `[0, 1]^2` of the unit vector `d`.
///
/// Round trips are bounded: the point of the vector of `p` is within `2e-7` of `p` along each axis,
/// or of the point that [`wrap`] says is the same as `p`.
#[inline]
#[must_use]
pub fn sphere_to_square(d: Vec3) -> Vec2 {
    let abs = d.abs();

    // 1 - |z|, without cancellation near the poles.
    let r = sqrt((abs.x * abs.x + abs.y * abs.y) / (1.0 + abs.z)).min(1.0);

    // The quadrant's angle as a fraction of a right angle.
    let major = abs.x.max(abs.y);
    let tan = if major == 0.0 {
        0.0
    } else {
        abs.x.min(abs.y) / major
    };
    let turn = atan(tan) * FRAC_2_PI;
    let turn = if abs.x < abs.y { 1.0 - turn } else { turn };

    let v = turn * r;
    let u = r - v;
    let (u, v) = if d.z < 0.0 {
        (1.0 - v, 1.0 - u)
    } else {
        (u, v)
    };
    0.5 * Vec2::new(u.copysign(d.x), v.copysign(d.y)) + 0.5
}

/// The point in `[0, 1]^2` that means the same direction as `p`, which lies at most one square
/// outside.
///
/// An edge of the square touches itself, turned around its midpoint.
#[inline]
#[must_use]
pub fn wrap(p: Vec2) -> Vec2 {
    let mut p = p;
    if p.x < 0.0 {
        p = Vec2::new(-p.x, 1.0 - p.y);
    } else if p.x > 1.0 {
        p = Vec2::new(2.0 - p.x, 1.0 - p.y);
    }
    if p.y < 0.0 {
        p = Vec2::new(1.0 - p.x, -p.y);
    } else if p.y > 1.0 {
        p = Vec2::new(1.0 - p.x, 2.0 - p.y);
    }
    p
}

/// The texel of an `n` x `n` image at `(x, y)`, which lies at most one image outside: [`wrap`] for
/// indices.
#[inline]
#[must_use]
#[expect(
    clippy::cast_sign_loss,
    clippy::cast_possible_wrap,
    reason = "sizes are far below 2^31, wrapped indices are positive"
)]
pub(crate) fn wrap_texel(x: i32, y: i32, n: u32) -> (u32, u32) {
    let n = n as i32;
    let (mut x, mut y) = (x, y);
    if x < 0 {
        (x, y) = (-1 - x, n - 1 - y);
    } else if x >= n {
        (x, y) = (2 * n - 1 - x, n - 1 - y);
    }
    if y < 0 {
        (x, y) = (n - 1 - x, -1 - y);
    } else if y >= n {
        (x, y) = (n - 1 - x, 2 * n - 1 - y);
    }
    (x as u32, y as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::float::safe_sqrt;
    use light_testkit::DensityTest;
    use proptest::prelude::*;

    #[test]
    fn landmarks() {
        let cases = [
            ((0.5, 0.5), Vec3::Z),
            ((0.0, 0.0), Vec3::NEG_Z),
            ((1.0, 1.0), Vec3::NEG_Z),
            ((1.0, 0.5), Vec3::X),
            ((0.0, 0.5), Vec3::NEG_X),
            ((0.5, 1.0), Vec3::Y),
            ((0.5, 0.0), Vec3::NEG_Y),
        ];
        for ((x, y), d) in cases {
            let p = Vec2::new(x, y);
            assert!(square_to_sphere(p).distance(d) < 1e-6, "{p} to {d}");
            let back = square_to_sphere(sphere_to_square(d));
            assert!(back.distance(d) < 1e-6, "{d} to {back}");
        }
    }

    /// Uniform points of the square are uniform directions, and the other way round.
    #[test]
    fn area_is_preserved_both_ways() {
        let test = DensityTest::default();
        let to_sphere = test.sphere(
            |rng| Some(square_to_sphere(rng.vec2())),
            |_| 0.25 * core::f32::consts::FRAC_1_PI,
        );
        assert_eq!(to_sphere.fault(), None, "{to_sphere:?}");
        let to_square = test.square(|rng| Some(sphere_to_square(rng.direction())), |_| 1.0);
        assert_eq!(to_square.fault(), None, "{to_square:?}");
    }

    /// Every coordinate of 16 bits on lines through the square, poles and equator included.
    #[test]
    fn round_trip_on_lines() {
        for i in 0..=u16::MAX {
            let s = f32::from(i) / 65535.0;
            for p in [(s, 0.5), (0.3, s), (s, s), (s, 1.0 - s), (s, 0.001)] {
                let p = Vec2::from(p);
                let d = square_to_sphere(p);
                let back = sphere_to_square(d);
                let on_border = p.min_element() < 1e-6 || p.max_element() > 1.0 - 1e-6;
                assert!(
                    back.distance(p) < 3e-7
                        || (on_border && square_to_sphere(back).distance(d) < 2e-6),
                    "{p} came back as {back}"
                );
            }
        }
    }

    #[test]
    fn edges_are_glued() {
        let outside = Vec2::new(-0.25, 0.75);
        assert_eq!(wrap(outside), Vec2::new(0.25, 0.25), "left edge");
        assert_eq!(wrap(Vec2::new(0.25, 1.25)), Vec2::new(0.75, 0.75), "top");
        assert_eq!(wrap(Vec2::splat(0.5)), Vec2::splat(0.5), "inside");
    }

    #[test]
    fn texels_wrap_as_their_centres_do() {
        let n = 8u32;
        for x in -8i16..16 {
            for y in -8i16..16 {
                let (i, j) = wrap_texel(i32::from(x), i32::from(y), n);
                let center = wrap((Vec2::new(f32::from(x), f32::from(y)) + 0.5) / 8.0) * 8.0;
                let texel = Vec2::new(i as f32, j as f32);
                assert_eq!(center, texel + 0.5, "texel {x} {y}");
            }
        }
    }

    proptest! {
        #[test]
        fn maps_are_inverse(
            z in -1.0f32..=1.0,
            phi in -3.2f32..3.2,
            x in 0.0f32..1.0,
            y in 0.0f32..1.0,
        ) {
            let p = Vec2::new(x, y);
            let d = square_to_sphere(p);
            prop_assert!((d.length() - 1.0).abs() < 5e-7, "unit length");
            prop_assert!((sphere_to_square(d) - p).abs().max_element() < 2e-7, "from the square");
            let r = safe_sqrt(1.0 - z * z);
            let w = Vec3::new(r * phi.cos(), r * phi.sin(), z).normalize();
            let back = square_to_sphere(sphere_to_square(w));
            prop_assert!(back.distance(w) < 2e-6, "from the sphere");
        }

        #[test]
        fn neighbours_across_an_edge_are_close(t in 0.0f32..=1.0, e in 0.0f32..1e-4) {
            for (outside, inside) in [
                (Vec2::new(-e, t), Vec2::new(e, t)), (Vec2::new(1.0 + e, t), Vec2::new(1.0 - e, t)),
                (Vec2::new(t, -e), Vec2::new(t, e)), (Vec2::new(t, 1.0 + e), Vec2::new(t, 1.0 - e)),
            ] {
                let gap = square_to_sphere(wrap(outside)).distance(square_to_sphere(inside));
                prop_assert!(gap < 1e-3, "{} and {}: {}", outside, inside, gap);
            }
        }
    }
}
