//! Builders of piecewise-constant tables.

use super::axis::Axis;
use super::cumulative;
use super::error::{TableError, check_len, positive_total};

/// The number of floats that the table of a line of `bins` bins takes.
pub(super) const fn line_len(bins: usize) -> usize {
    2 * bins + 1
}

/// The number of floats that the table of a grid takes.
pub(super) const fn grid_len(nx: usize, ny: usize) -> usize {
    ny * (2 * nx + 1) + ny + 1
}

/// Fills the table of a line; returns its bins and the mean weight.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounds densities and the mean"
)]
pub(super) const fn fill_line(
    weights: &[f32],
    table: &mut [f32],
) -> Result<(Axis, f32), TableError> {
    let axis = match Axis::unit(weights.len()) {
        Ok(axis) => axis,
        Err(error) => return Err(error),
    };
    let total = match positive_total(weights) {
        Ok(total) => total,
        Err(error) => return Err(error),
    };
    if let Err(error) = check_len(line_len(weights.len()), table.len()) {
        return Err(error);
    }
    let mean = total / weights.len() as f64;
    let (densities, sums) = table.split_at_mut(weights.len());
    let mut i = 0;
    while i < weights.len() {
        densities[i] = (weights[i] as f64 / mean) as f32;
        i += 1;
    }
    cumulative::accumulate(densities, sums);
    Ok((axis, mean as f32))
}

/// Fills the table of a grid; returns its axes and the mean weight.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounds densities and the mean"
)]
pub(super) const fn fill_grid(
    weights: &[f32],
    nx: usize,
    ny: usize,
    table: &mut [f32],
) -> Result<([Axis; 2], f32), TableError> {
    let axes = match (Axis::unit(nx), Axis::unit(ny)) {
        (Ok(x), Ok(y)) => [x, y],
        (Err(error), _) | (_, Err(error)) => return Err(error),
    };
    if let Err(error) = check_len(nx.saturating_mul(ny), weights.len()) {
        return Err(error);
    }
    if let Err(error) = check_len(grid_len(nx, ny), table.len()) {
        return Err(error);
    }
    let total = match positive_total(weights) {
        Ok(total) => total,
        Err(error) => return Err(error),
    };
    let mean = total / weights.len() as f64;
    let (mut densities, sums) = table.split_at_mut(nx * ny);
    let (mut sums, marginal) = sums.split_at_mut(ny * (nx + 1));
    // The sum of what is stored, so that the rows end at 1 even where the last ones are empty.
    let mut sum = 0.0;
    let mut i = 0;
    while i < densities.len() {
        densities[i] = (weights[i] as f64 / mean) as f32;
        sum += densities[i] as f64;
        i += 1;
    }

    let mut below = 0.0;
    let mut row = 0;
    while row < ny {
        let (row_densities, other_densities) = densities.split_at_mut(nx);
        let (row_sums, other_sums) = sums.split_at_mut(nx + 1);
        marginal[row] = cumulative::share(below, sum);
        below += cumulative::accumulate(row_densities, row_sums);
        (densities, sums) = (other_densities, other_sums);
        row += 1;
    }
    marginal[ny] = 1.0;
    Ok((axes, mean as f32))
}
