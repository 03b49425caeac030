//! The uniform unit disk in polar coordinates.

use super::{azimuth, invert_azimuth};
use crate::float::sqrt;
use glam::Vec2;

/// The point of the unit disk at radius `sqrt(u.x)` and azimuth `2 pi u.y`.
#[inline]
#[must_use]
pub fn sample(u: Vec2) -> Vec2 {
    azimuth(u.y) * sqrt(u.x)
}

pub use super::concentric_disk::pdf;

/// The `u` in `[0, 1]^2` that [`sample`] takes to `p`; `u.y` is 0 at the centre.
#[must_use]
pub fn invert(p: Vec2) -> Vec2 {
    Vec2::new(p.length_squared().min(1.0), invert_azimuth(p.x, p.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fixed_points_and_inverse() {
        assert_eq!(sample(Vec2::new(0.0, 0.3)), Vec2::ZERO, "centre");
        assert!(
            sample(Vec2::new(0.25, 0.25)).distance(Vec2::new(0.0, 0.5)) < 1e-6,
            "quarter turn"
        );
        for i in 0..50 {
            let u = Vec2::new(i as f32 + 0.5, 49.5 - i as f32) / 50.0;
            assert!(invert(sample(u)).distance(u) < 1e-6, "round trip of {u}");
            assert!(pdf(sample(u)) > 0.0, "density at {u}");
        }
    }
}
