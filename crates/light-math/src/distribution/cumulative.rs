//! One row of a piecewise-constant table: densities and their running sum.

use crate::float::ONE_MINUS_EPSILON;

/// Writes the running sum of `densities` over its total, from 0 to 1, and returns the total.
///
/// The sum of a row without density rises evenly, so that inverting it stays defined.
pub(super) const fn accumulate(densities: &[f32], sums: &mut [f32]) -> f64 {
    let len = densities.len();
    let mut total = 0.0;
    let mut i = 0;
    while i < len {
        total += densities[i] as f64;
        i += 1;
    }
    let mut partial = 0.0;
    let mut i = 0;
    while i < len {
        sums[i] = if total > 0.0 {
            share(partial, total)
        } else {
            i as f32 / len as f32
        };
        partial += densities[i] as f64;
        i += 1;
    }
    sums[len] = 1.0;
    total
}

/// A running sum as a share of the sum of all, in `f32`.
#[expect(clippy::cast_possible_truncation, reason = "rounds a share")]
pub(super) const fn share(partial: f64, total: f64) -> f32 {
    (partial / total) as f32
}

/// The bin for `u`, one of positive density, and the place in it in `[0, 1]`.
#[inline]
pub(super) fn sample(sums: &[f32], u: f32) -> (usize, f32) {
    let u = if u > 0.0 {
        u.min(ONE_MINUS_EPSILON)
    } else {
        0.0
    };
    // The last bin that starts at or below u ends above it, so it has a width.
    let bin = sums.partition_point(|&sum| sum <= u).saturating_sub(1);
    (bin, (u - sums[bin]) / (sums[bin + 1] - sums[bin]))
}

/// The `u` that [`sample`] takes to `place` of `bin`.
#[inline]
pub(super) fn invert(sums: &[f32], bin: usize, place: f32) -> f32 {
    sums[bin] + place * (sums[bin + 1] - sums[bin])
}

/// Whether `sums` rises from 0 to 1 and rises only where there is density.
pub(super) fn is_well_formed(densities: &[f32], sums: &[f32]) -> bool {
    let steps = densities.iter().zip(sums.windows(2));
    let is_density = |d: f32| d >= 0.0 && d.is_finite();
    let all_zero = densities.iter().all(|&d| d == 0.0);
    sums.first() == Some(&0.0)
        && sums.last() == Some(&1.0)
        && steps
            .into_iter()
            .all(|(&d, s)| is_density(d) && s[0] <= s[1] && (d > 0.0 || s[0] == s[1] || all_zero))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn skips_what_has_no_density() {
        let densities = [0.0, 1.0, 0.0, 3.0, 0.0];
        let mut sums = [0.0; 6];
        assert_eq!(accumulate(&densities, &mut sums), 4.0, "total");
        assert_eq!(sums, [0.0, 0.0, 0.25, 0.25, 1.0, 1.0], "running sum");
        assert!(is_well_formed(&densities, &sums), "its own sum");
        assert_eq!(sample(&sums, 0.0), (1, 0.0), "lower end");
        assert_eq!(sample(&sums, 0.25), (3, 0.0), "at a gap");
        assert_eq!(sample(&sums, 0.625), (3, 0.5), "within a bin");
        assert_eq!(sample(&sums, 1.0).0, 3, "upper end");
        assert_eq!(sample(&sums, f32::NAN).0, 1, "NaN");
    }

    #[test]
    fn a_row_without_density_is_even() {
        let mut sums = [0.0; 5];
        assert_eq!(accumulate(&[0.0; 4], &mut sums), 0.0, "total");
        assert_eq!(sums, [0.0, 0.25, 0.5, 0.75, 1.0], "even");
        assert_eq!(invert(&sums, 2, 0.5), 0.625, "inverse");
    }
}
