//! The density on the unit square that interpolates its values at the corners.
//!
//! The values `w` stand in the order `(0,0)`, `(1,0)`, `(0,1)`, `(1,1)` and are not negative; if
//! all are 0 (or one is not finite) the density is uniform.

use super::linear;
use crate::float::inverse_power_of_two;
use glam::Vec2;

/// The point of the square for `u`.
///
/// # Source
/// `[PBRT4]` 2.4.2: first y by the line between the two rows' sums, then x by the line across the
/// row.
#[inline]
#[must_use]
pub fn sample(u: Vec2, w: [f32; 4]) -> Vec2 {
    let Some(w) = scaled(w) else {
        return u;
    };
    let y = linear::sample(u.y, w[0] + w[1], w[2] + w[3]);
    let (a, b) = row(y, w);
    Vec2::new(linear::sample(u.x, a, b), y)
}

/// The density per area at `p`; 0 outside the square.
#[inline]
#[must_use]
pub fn pdf(p: Vec2, w: [f32; 4]) -> f32 {
    if !(p.cmpge(Vec2::ZERO) & p.cmple(Vec2::ONE)).all() {
        return 0.0;
    }
    let Some(w) = scaled(w) else {
        return 1.0;
    };
    let (a, b) = row(p.y, w);
    4.0 * ((1.0 - p.x) * a + p.x * b) / (w[0] + w[1] + w[2] + w[3])
}

/// The `u` in `[0, 1]^2` that [`sample`] takes to `p`.
#[inline]
#[must_use]
pub fn invert(p: Vec2, w: [f32; 4]) -> Vec2 {
    let Some(w) = scaled(w) else {
        return p;
    };
    let (a, b) = row(p.y, w);
    let y = linear::invert(p.y, w[0] + w[1], w[2] + w[3]);
    Vec2::new(linear::invert(p.x, a, b), y)
}

/// The values at both ends of the row at height `y`.
#[inline]
fn row(y: f32, w: [f32; 4]) -> (f32, f32) {
    let z = 1.0 - y;
    (z * w[0] + y * w[2], z * w[1] + y * w[3])
}

/// The values in a unit in which the largest is near 1; `None` if that is no positive number.
#[inline]
fn scaled(w: [f32; 4]) -> Option<[f32; 4]> {
    let largest = w[0].max(w[1]).max(w[2].max(w[3]));
    let valid = w.iter().all(|&value| value >= 0.0) && largest > 0.0 && largest.is_finite();
    let scale = inverse_power_of_two(largest);
    valid.then(|| w.map(|value| value * scale))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::float::ONE_MINUS_EPSILON;

    #[test]
    fn fixed_points() {
        let u = Vec2::new(0.25, 0.75);
        assert_eq!(sample(u, [1.0; 4]), u, "constant");
        assert_eq!(sample(u, [0.0; 4]), u, "no values at all");
        assert_eq!(pdf(Vec2::ONE, [0.0, 0.0, 0.0, 1.0]), 4.0, "one corner");
        assert_eq!(pdf(Vec2::splat(1.1), [1.0; 4]), 0.0, "outside");
    }

    #[test]
    fn density_is_positive_and_inverse_holds() {
        let corners = [
            [0.0, 0.0, 0.0, 1.0],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1e-30, 1.0, 0.0],
            [1e38, 2e38, 3e38, 3e38],
            [1e-38, 2e-38, 0.0, 1e-38],
        ];
        for w in corners {
            for x in [0.0, 0.3, 0.8, ONE_MINUS_EPSILON] {
                for y in [0.0, 0.3, 0.8, ONE_MINUS_EPSILON] {
                    let u = Vec2::new(x, y);
                    let p = sample(u, w);
                    assert!(pdf(p, w) > 0.0, "density for {u} {w:?}");
                    assert!(invert(p, w).distance(u) < 2e-6, "round trip {u} {w:?}");
                }
            }
        }
    }
}
