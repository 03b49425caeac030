//! Directions around +z with a density proportional to the cosine: Lambertian emission and
//! reflection.

use super::concentric_disk;
use crate::float::{sin_cos, sqrt};
use core::f32::consts::FRAC_1_PI;
use glam::{Vec2, Vec3};

/// The unit vector above the concentric disk's point for `u`; `z > 0` always.
///
/// # Source
/// Malley's method, `[PBRT4]` A.5.3.
#[inline]
#[must_use]
pub fn sample(u: Vec2) -> Vec3 {
    let (r, phi) = concentric_disk::polar(u);
    let (sin_phi, cos_phi) = sin_cos(phi);
    // The rim itself has no density, so stay above it by less than a rounding of the unit length.
    let z = sqrt((1.0 - r) * (1.0 + r)).max(f32::EPSILON);
    Vec3::new(r * cos_phi, r * sin_phi, z)
}

/// The density per solid angle of a direction with `z = cos_theta`: `cos_theta / pi`, 0 below the
/// horizon.
#[inline]
#[must_use]
pub fn pdf(cos_theta: f32) -> f32 {
    if cos_theta > 0.0 {
        cos_theta * FRAC_1_PI
    } else {
        0.0
    }
}

/// The `u` in `[0, 1]^2` that [`sample`] takes to the unit vector `w`.
#[must_use]
pub fn invert(w: Vec3) -> Vec2 {
    concentric_disk::invert(w.truncate())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::float::ONE_MINUS_EPSILON;

    #[test]
    fn density_is_positive_up_to_the_corners_of_the_square() {
        for x in [0.0, 0.5, ONE_MINUS_EPSILON] {
            for y in [0.0, 0.5, ONE_MINUS_EPSILON] {
                let w = sample(Vec2::new(x, y));
                assert!(w.is_normalized() && pdf(w.z) > 0.0, "density at {x} {y}");
            }
        }
    }

    #[test]
    fn inverse() {
        for i in 0..50 {
            let u = Vec2::new(i as f32 + 0.5, 49.5 - i as f32) / 50.0;
            assert!(invert(sample(u)).distance(u) < 1e-6, "round trip of {u}");
        }
        assert_eq!(pdf(1.0), FRAC_1_PI, "pole");
        assert_eq!(pdf(f32::NAN), 0.0, "NaN");
    }
}
