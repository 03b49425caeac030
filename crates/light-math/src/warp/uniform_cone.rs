//! Uniform directions in a cone around +z.
//!
//! The cone is given by the height of its cap, `one_minus_cos_theta_max = 1 - cos(theta_max)` in
//! `(0, 2]`: a narrow cone, such as the one toward a far sphere, would lose all its digits in the
//! cosine itself. From a sine it is `sin^2 / (1 + cos)`.

use super::{azimuth, invert_azimuth};
use crate::float::sqrt;
use core::f32::consts::TAU;
use glam::{Vec2, Vec3};

/// The unit vector with `1 - z = u.x * one_minus_cos_theta_max` and azimuth `2 pi u.y`.
///
/// # Source
/// `[PBRT4]` A.5.4, with `1 - cos` in place of `cos`.
#[inline]
#[must_use]
pub fn sample(u: Vec2, one_minus_cos_theta_max: f32) -> Vec3 {
    let height = u.x * one_minus_cos_theta_max;
    let sin_theta = sqrt(height * (2.0 - height));
    (azimuth(u.y) * sin_theta).extend(1.0 - height)
}

/// The density per solid angle within the cone, `1 / (2 pi (1 - cos theta_max))`; 0 for a cone
/// without extent.
#[inline]
#[must_use]
pub fn pdf(one_minus_cos_theta_max: f32) -> f32 {
    if one_minus_cos_theta_max > 0.0 {
        1.0 / (TAU * one_minus_cos_theta_max)
    } else {
        0.0
    }
}

/// The `u` in `[0, 1]^2` that [`sample`] takes to the unit vector `w` of the cone; `u.y` is 0 on
/// the axis.
#[must_use]
pub fn invert(w: Vec3, one_minus_cos_theta_max: f32) -> Vec2 {
    // Above the equator the sine has more digits than 1 - z.
    let height = if w.z > 0.0 {
        w.truncate().length_squared() / (1.0 + w.z)
    } else {
        1.0 - w.z
    };
    let x = (height / one_minus_cos_theta_max).min(1.0);
    Vec2::new(x, invert_azimuth(w.x, w.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_for_wide_and_for_very_narrow_cones() {
        for cap in [2.0, 1.0, 0.5, 1e-3, 1e-8, 1e-16] {
            for i in 0..50 {
                let u = Vec2::new(i as f32 + 0.5, 49.5 - i as f32) / 50.0;
                let w = sample(u, cap);
                assert!(w.is_normalized(), "unit vector of {u}");
                assert!(
                    invert(w, cap).distance(u) < 4e-6,
                    "round trip of {u}, cap {cap}"
                );
            }
        }
    }

    #[test]
    fn whole_sphere_and_nothing() {
        assert_eq!(
            pdf(2.0),
            super::super::uniform_sphere::pdf(),
            "whole sphere"
        );
        assert_eq!(pdf(0.0), 0.0, "no extent");
    }
}
