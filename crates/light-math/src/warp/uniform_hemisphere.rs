//! Uniform directions around +z.

use super::{azimuth, invert_azimuth};
use crate::float::sqrt;
use core::f32::consts::FRAC_1_PI;
use glam::{Vec2, Vec3};

/// The unit vector with `z = u.x` and azimuth `2 pi u.y`.
#[inline]
#[must_use]
pub fn sample(u: Vec2) -> Vec3 {
    let z = u.x;
    (azimuth(u.y) * sqrt(1.0 - z * z)).extend(z)
}

/// The density per solid angle of a direction with `z = cos_theta`: `1 / (2 pi)`, 0 below the
/// horizon.
#[inline]
#[must_use]
pub fn pdf(cos_theta: f32) -> f32 {
    if cos_theta >= 0.0 {
        0.5 * FRAC_1_PI
    } else {
        0.0
    }
}

/// The `u` in `[0, 1]^2` that [`sample`] takes to the unit vector `w`; `u.y` is 0 at the pole.
#[must_use]
pub fn invert(w: Vec3) -> Vec2 {
    Vec2::new(w.z.clamp(0.0, 1.0), invert_azimuth(w.x, w.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fixed_points_and_inverse() {
        assert_eq!(sample(Vec2::ZERO), Vec3::X, "horizon");
        assert_eq!(pdf(-0.1), 0.0, "below");
        for i in 0..50 {
            let u = Vec2::new(i as f32 + 0.5, 49.5 - i as f32) / 50.0;
            let w = sample(u);
            assert!(w.is_normalized() && pdf(w.z) > 0.0, "unit vector of {u}");
            assert!(invert(w).distance(u) < 1e-6, "round trip of {u}");
        }
    }
}
