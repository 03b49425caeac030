//! Weights of multiple importance sampling.
//!
//! A weight belongs to the technique whose density is the first argument; the weights of all
//! techniques sum to 1. Where a technique takes several samples, pass its density times their
//! number. An infinite density is that of a Dirac: it takes the whole weight. A technique without
//! density gets 0, and so does NaN.

/// The balance heuristic, `p / (p + q)`.
///
/// # Source
/// `[Veach1997]`, section 9.2.2.
#[inline]
#[must_use]
pub fn balance(pdf: f32, other: f32) -> f32 {
    ratio(pdf, other).map_or(0.0, |r| 1.0 / (1.0 + r))
}

/// The power heuristic with exponent 2, `p^2 / (p^2 + q^2)`.
///
/// # Source
/// `[Veach1997]`, section 9.2.3.
#[inline]
#[must_use]
pub fn power(pdf: f32, other: f32) -> f32 {
    ratio(pdf, other).map_or(0.0, |r| 1.0 / (1.0 + r * r))
}

/// `other / pdf`, which may overflow to infinity but is never NaN; `None` if the weight is 0.
#[inline]
fn ratio(pdf: f32, other: f32) -> Option<f32> {
    if !(pdf > 0.0) || other.is_nan() {
        None
    } else if pdf.is_infinite() {
        Some(if other.is_infinite() { 1.0 } else { 0.0 })
    } else {
        Some(other.max(0.0) / pdf)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fixed_points() {
        assert_eq!(balance(1.0, 3.0), 0.25, "balance");
        assert_eq!(power(1.0, 3.0), 0.1, "power");
        assert_eq!(power(2.0, 0.0), 1.0, "alone");
        assert_eq!(
            (balance(0.0, 2.0), power(0.0, 0.0)),
            (0.0, 0.0),
            "without density"
        );
    }

    #[test]
    fn weights_sum_to_one_at_the_ends_of_the_range() {
        let densities = [1e-40, 1e-20, 1.0, 1e20, f32::MAX, f32::INFINITY];
        for p in densities {
            for q in densities {
                for weight in [balance, power] {
                    let sum = weight(p, q) + weight(q, p);
                    assert!((sum - 1.0).abs() < 1e-6, "{p} {q}: {sum}");
                }
            }
        }
        assert_eq!(power(f32::NAN, 1.0), 0.0, "NaN");
        assert_eq!(balance(1.0, f32::NAN), 0.0, "NaN");
    }
}
