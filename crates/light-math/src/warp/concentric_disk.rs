//! The uniform unit disk, by a map that keeps neighbours of the square together.

use crate::float::{atan2, sin_cos};
use core::f32::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI, TAU};
use glam::Vec2;

/// The point of the unit disk for `u`; squares around the centre become circles.
///
/// # Source
/// `[Shirley1997]`, in the form of `[PBRT4]` A.5.1.
#[inline]
#[must_use]
pub fn sample(u: Vec2) -> Vec2 {
    let (r, phi) = polar(u);
    let (sin_phi, cos_phi) = sin_cos(phi);
    Vec2::new(cos_phi, sin_phi) * r
}

/// The same point as a signed radius and an azimuth.
#[inline]
pub(super) fn polar(u: Vec2) -> (f32, f32) {
    let offset = u * 2.0 - Vec2::ONE;
    if offset == Vec2::ZERO {
        (0.0, 0.0)
    } else if offset.x.abs() > offset.y.abs() {
        (offset.x, FRAC_PI_4 * (offset.y / offset.x))
    } else {
        (offset.y, FRAC_PI_2 - FRAC_PI_4 * (offset.x / offset.y))
    }
}

/// The density per area at `p`: `1 / pi` in the disk, 0 outside.
#[inline]
#[must_use]
pub fn pdf(p: Vec2) -> f32 {
    // A sample on the rim may lie outside by its rounding.
    if p.length_squared() <= 1.0 + 4.0 * f32::EPSILON {
        FRAC_1_PI
    } else {
        0.0
    }
}

/// The `u` in `[0, 1]^2` that [`sample`] takes to `p`, a point of the disk.
#[must_use]
pub fn invert(p: Vec2) -> Vec2 {
    let r = p.length();
    // The azimuth from -pi/4 on, so that each quarter belongs to one side of the square.
    let phi = atan2(p.y, p.x);
    let phi = if phi < -FRAC_PI_4 { phi + TAU } else { phi };
    let along = |center: f32| (phi - center) * r / FRAC_PI_4;
    let offset = if phi < FRAC_PI_4 {
        Vec2::new(r, along(0.0))
    } else if phi < 3.0 * FRAC_PI_4 {
        Vec2::new(-along(FRAC_PI_2), r)
    } else if phi < 5.0 * FRAC_PI_4 {
        Vec2::new(-r, -along(PI))
    } else {
        Vec2::new(along(3.0 * FRAC_PI_2), -r)
    };
    ((offset + Vec2::ONE) * 0.5).clamp(Vec2::ZERO, Vec2::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fixed_points() {
        assert_eq!(sample(Vec2::splat(0.5)), Vec2::ZERO, "centre");
        let right = sample(Vec2::new(1.0, 0.5));
        assert!(right.distance(Vec2::X) < 1e-7, "right side {right}");
        let corner = sample(Vec2::ZERO);
        let diagonal = -Vec2::ONE.normalize();
        assert!(corner.distance(diagonal) < 1e-6, "corner {corner}");
    }

    #[test]
    fn inverse_in_all_four_quarters() {
        for i in 0..20 {
            for j in 0..20 {
                let u = Vec2::new(i as f32 + 0.3, j as f32 + 0.6) / 20.0;
                let p = sample(u);
                assert!(pdf(p) > 0.0, "density at {u}");
                assert!(invert(p).distance(u) < 1e-6, "round trip of {u}");
            }
        }
    }
}
