//! The density on `[0, 1]` that is proportional to a straight line.
//!
//! The line has the values `a` at 0 and `b` at 1, neither negative; if both are 0 (or one is not
//! finite) the density is uniform.

use crate::float::{ONE_MINUS_EPSILON, inverse_power_of_two, sqrt};

/// A start of the line, over its end, that counts as zero: products of two such densities would
/// vanish.
pub(super) const NEGLIGIBLE: f32 = 1e-20;

/// The `x` in `[0, 1)` for `u`.
///
/// # Source
/// `[PBRT4]` 2.3.2, with the line scaled so that its squares neither overflow nor vanish.
#[inline]
#[must_use]
pub fn sample(u: f32, a: f32, b: f32) -> f32 {
    let Some((a, b)) = scaled(a, b) else {
        return u;
    };
    // Of the smallest `u` the square may vanish: a quotient by 0 would be the other end.
    let square = (1.0 - u) * (a * a) + u * (b * b);
    let x = u * (a + b) / (a + sqrt(square.max(f32::MIN_POSITIVE)));
    // Where the line starts at zero, so does the density: stay off that end as the other end does.
    let lowest = if a > NEGLIGIBLE {
        0.0
    } else {
        f32::EPSILON * 0.5
    };
    x.max(lowest).min(ONE_MINUS_EPSILON)
}

/// The density at `x`; 0 outside `[0, 1]`.
#[inline]
#[must_use]
pub fn pdf(x: f32, a: f32, b: f32) -> f32 {
    if !(0.0..=1.0).contains(&x) {
        return 0.0;
    }
    match scaled(a, b) {
        Some((a, b)) => 2.0 * ((1.0 - x) * a + x * b) / (a + b),
        None => 1.0,
    }
}

/// The `u` in `[0, 1]` that [`sample`] takes to `x`.
#[inline]
#[must_use]
pub fn invert(x: f32, a: f32, b: f32) -> f32 {
    match scaled(a, b) {
        Some((a, b)) => x * (a * (2.0 - x) + b * x) / (a + b),
        None => x,
    }
}

/// The two values in a unit in which the larger is near 1; `None` if that is no positive number.
#[inline]
fn scaled(a: f32, b: f32) -> Option<(f32, f32)> {
    let largest = a.max(b);
    let valid = a >= 0.0 && b >= 0.0 && largest > 0.0 && largest.is_finite();
    let scale = inverse_power_of_two(largest);
    valid.then_some((a * scale, b * scale))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fixed_points() {
        assert_eq!(sample(0.0, 1.0, 3.0), 0.0, "start");
        assert_eq!(sample(0.25, 2.0, 2.0), 0.25, "constant");
        assert!((sample(0.25, 0.0, 1.0) - 0.5).abs() < 1e-7, "square root");
        assert!(sample(1e-45, 0.0, 3.5e-39) < 1e-7, "the smallest number");
        assert_eq!(pdf(0.25, 0.0, 1.0), 0.5, "2 x");
        assert_eq!(pdf(1.5, 1.0, 1.0), 0.0, "outside");
    }

    #[test]
    fn density_is_positive_and_inverse_holds_over_all_scales() {
        let values = [0.0, f32::MIN_POSITIVE, 1e-30, 1.0, 1e30, f32::MAX];
        for a in values {
            for b in values {
                for u in [0.0, 0.1, 0.5, 0.9, ONE_MINUS_EPSILON] {
                    let x = sample(u, a, b);
                    assert!((0.0..1.0).contains(&x), "range: {x} for {u} {a} {b}");
                    assert!(pdf(x, a, b) > 0.0, "density for {u} {a} {b}");
                    assert!((invert(x, a, b) - u).abs() < 1e-6, "round trip {u} {a} {b}");
                }
            }
        }
    }
}
