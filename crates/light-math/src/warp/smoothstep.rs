//! The density on `[a, b]` that is proportional to the cubic step from 0 at `a` to 1 at `b`.
//!
//! With `a = b` the step has no width: every sample is `a`, and its density is 0, for the caller to
//! handle.

use crate::float::{cbrt, next_up};

/// The `x` in `[a, b]` for `u` in `[0, 1)`, with `a <= b`.
///
/// # Source
/// `[PBRT4]` A.4.6 inverts by bisection. Ours starts above the root of the convex
/// `t^3 (2 - t) - u`, from where Newton's steps come down to it and cannot leave the interval.
#[inline]
#[must_use]
pub fn sample(u: f32, a: f32, b: f32) -> f32 {
    // t^3 <= u, and what is known of t bounds it again.
    let mut t = cbrt(u / (2.0 - cbrt(u)));
    for _ in 0..3 {
        let slope = 2.0 * t * t * (3.0 - 2.0 * t);
        if slope > 0.0 {
            t -= (t * t * t * (2.0 - t) - u) / slope;
        }
    }
    // The density starts at zero: stay off that end.
    let x = a + (b - a) * t.clamp(f32::EPSILON * 0.5, 1.0);
    x.max(next_up(a)).min(b)
}

/// The density at `x`, per unit of `x`; 0 outside `[a, b]`.
#[inline]
#[must_use]
pub fn pdf(x: f32, a: f32, b: f32) -> f32 {
    let t = (x - a) / (b - a);
    if (0.0..=1.0).contains(&t) {
        2.0 * t * t * (3.0 - 2.0 * t) / (b - a)
    } else {
        0.0
    }
}

/// The `u` in `[0, 1]` that [`sample`] takes to `x`.
#[inline]
#[must_use]
pub fn invert(x: f32, a: f32, b: f32) -> f32 {
    let t = if b > a {
        ((x - a) / (b - a)).clamp(0.0, 1.0)
    } else {
        0.0
    };
    t * t * t * (2.0 - t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::float::ONE_MINUS_EPSILON;

    #[test]
    fn inverse_is_as_exact_as_floats_allow() {
        for i in 0..4096u16 {
            let u = f32::from(i) / 4096.0;
            let x = sample(u, 0.0, 1.0);
            assert!(
                (invert(x, 0.0, 1.0) - u).abs() < 4e-7,
                "round trip of {u}: {x}"
            );
        }
    }

    #[test]
    fn density_is_positive_at_both_ends() {
        for (a, b) in [
            (0.0, 1.0),
            (-2.0, 3.0),
            (0.999, 0.9991),
            (1e-30, 1.0),
            (-1e30, 1e30),
        ] {
            for u in [0.0, f32::MIN_POSITIVE, 1e-9, 0.5, ONE_MINUS_EPSILON] {
                let x = sample(u, a, b);
                assert!((a..=b).contains(&x), "range for {u} {a} {b}: {x}");
                assert!(pdf(x, a, b) > 0.0, "density for {u} {a} {b}");
            }
        }
    }

    #[test]
    fn fixed_points() {
        assert_eq!(pdf(0.5, 0.0, 1.0), 1.0, "middle");
        assert_eq!(
            (pdf(-0.1, 0.0, 1.0), pdf(1.1, 0.0, 1.0)),
            (0.0, 0.0),
            "outside"
        );
        assert_eq!(sample(0.3, 2.0, 2.0), 2.0, "no width");
        assert_eq!(
            (pdf(2.0, 2.0, 2.0), invert(2.0, 2.0, 2.0)),
            (0.0, 0.0),
            "no width"
        );
    }
}
