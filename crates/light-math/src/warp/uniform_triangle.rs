//! Uniform barycentric coordinates.

use glam::{Vec2, Vec3};

/// Barycentric coordinates for `u`, not negative and of sum 1.
///
/// # Source
/// `[Heitz2019]`, in the form of `[PBRT4]` 6.5.2: low distortion, and no square root.
#[inline]
#[must_use]
pub fn sample(u: Vec2) -> Vec3 {
    let (b0, b1) = if u.x < u.y {
        let b0 = 0.5 * u.x;
        (b0, u.y - b0)
    } else {
        let b1 = 0.5 * u.y;
        (u.x - b1, b1)
    };
    Vec3::new(b0, b1, 1.0 - b0 - b1)
}

/// The density per area on a triangle of the given `area`; 0 if that is not positive.
#[inline]
#[must_use]
pub fn pdf(area: f32) -> f32 {
    if area > 0.0 { 1.0 / area } else { 0.0 }
}

/// The `u` in `[0, 1]^2` that [`sample`] takes to the barycentric coordinates `b`.
#[must_use]
pub fn invert(b: Vec3) -> Vec2 {
    if b.x > b.y {
        Vec2::new(b.x + b.y, 2.0 * b.y)
    } else {
        Vec2::new(2.0 * b.x, b.y + b.x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::float::ONE_MINUS_EPSILON;

    #[test]
    fn coordinates_are_barycentric() {
        for x in [0.0, 0.3, 0.8, ONE_MINUS_EPSILON] {
            for y in [0.0, 0.3, 0.8, ONE_MINUS_EPSILON] {
                let u = Vec2::new(x, y);
                let b = sample(u);
                assert!(b.min_element() >= 0.0, "inside {u}: {b}");
                assert!((b.element_sum() - 1.0).abs() < 1e-6, "sum of {u}");
                assert!(invert(b).distance(u) < 1e-6, "round trip of {u}");
            }
        }
    }

    #[test]
    fn density() {
        assert_eq!(
            (pdf(2.0), pdf(0.0), pdf(f32::NAN)),
            (0.5, 0.0, 0.0),
            "per area"
        );
    }
}
