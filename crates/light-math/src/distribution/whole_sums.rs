use core::ops::RangeInclusive;

use super::axis::Axis;
use super::error::{TableError, check_len, total};

/// The exponents of units: from the smallest `f32` as the total to the sum of 2^48 of the largest.
pub(super) const UNITS: RangeInclusive<i32> = -149 - LOG2_TOTAL..=127 + 48 - LOG2_TOTAL;

/// The total has this many bits and one more, with room for the weights that are rounded up.
const LOG2_TOTAL: i32 = 61;

/// Fills `sums`; returns the exponent of their unit.
pub(super) const fn fill(
    weights: &[f32],
    nx: usize,
    ny: usize,
    sums: &mut [u64],
) -> Result<i32, TableError> {
    match (Axis::unit(nx), Axis::unit(ny)) {
        (Ok(_), Ok(_)) => {}
        (Err(error), _) | (_, Err(error)) => return Err(error),
    }
    let total = match (
        check_len(nx.saturating_mul(ny), weights.len()),
        total(weights),
    ) {
        (Ok(()), Ok(total)) => total,
        (Err(error), _) | (_, Err(error)) => return Err(error),
    };
    if let Err(error) = check_len(weights.len(), sums.len()) {
        return Err(error);
    }
    let log2_unit = if total > 0.0 {
        (total.to_bits() >> 52) as i32 - 1023 - LOG2_TOTAL
    } else {
        0
    };
    let scale = power_of_two(-log2_unit);
    let mut y = 0;
    while y < ny {
        let mut row = 0;
        let mut x = 0;
        while x < nx {
            let i = y * nx + x;
            row += round_up(weights[i] as f64 * scale);
            sums[i] = row + if y > 0 { sums[i - nx] } else { 0 };
            x += 1;
        }
        y += 1;
    }
    Ok(log2_unit)
}

#[expect(
    clippy::cast_sign_loss,
    reason = "exponents of sums of f32 stay far inside the range"
)]
pub(super) const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// The smallest whole number not below `x`, which is not negative and below 2^63.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the integer part is wanted"
)]
const fn round_up(x: f64) -> u64 {
    let whole = x as u64;
    if (whole as f64) < x { whole + 1 } else { whole }
}
