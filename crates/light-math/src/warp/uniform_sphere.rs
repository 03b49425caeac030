//! Uniform directions on the whole sphere.

use super::{azimuth, invert_azimuth};
use crate::float::sqrt;
use core::f32::consts::FRAC_1_PI;
use glam::{Vec2, Vec3};

/// The unit vector with `z = 1 - 2 u.x` and azimuth `2 pi u.y`.
#[inline]
#[must_use]
pub fn sample(u: Vec2) -> Vec3 {
    let z = 1.0 - 2.0 * u.x;
    (azimuth(u.y) * sqrt(1.0 - z * z)).extend(z)
}

/// The density per solid angle: `1 / (4 pi)` everywhere.
#[inline]
#[must_use]
pub const fn pdf() -> f32 {
    0.25 * FRAC_1_PI
}

/// The `u` in `[0, 1]^2` that [`sample`] takes to the unit vector `w`; `u.y` is 0 at the poles.
#[must_use]
pub fn invert(w: Vec3) -> Vec2 {
    let x = ((1.0 - w.z) * 0.5).clamp(0.0, 1.0);
    Vec2::new(x, invert_azimuth(w.x, w.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fixed_points_and_inverse() {
        assert_eq!(sample(Vec2::ZERO), Vec3::Z, "north pole");
        for i in 0..50 {
            let u = Vec2::new(i as f32 + 0.5, 49.5 - i as f32) / 50.0;
            let w = sample(u);
            assert!(w.is_normalized(), "unit vector of {u}");
            assert!(invert(w).distance(u) < 1e-6, "round trip of {u}");
        }
    }
}
