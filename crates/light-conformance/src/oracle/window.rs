//! Piecewise-constant densities within a window, by sums in double precision.

use super::table::ExactTable;
use lights::math::glam::DVec2;

/// A density that is restricted to windows of the unit square.
#[derive(Clone, Debug)]
pub(crate) struct ExactWindows(pub(crate) ExactTable);

impl ExactWindows {
    /// The integral over the rectangle between two corners of the unit square.
    pub(crate) fn integral(&self, low: DVec2, high: DVec2) -> f64 {
        self.columns([low, high]).iter().sum()
    }

    /// The integral over each column of texels within a window.
    fn columns(&self, [low, high]: [DVec2; 2]) -> Vec<f64> {
        let table = &self.0;
        let mut columns = vec![0.0; table.nx];
        for (y, row) in table.weights.chunks(table.nx).enumerate() {
            let height = overlap(low.y, high.y, y, table.ny);
            if height > 0.0 {
                for (column, weight) in columns.iter_mut().zip(row) {
                    *column += weight * height;
                }
            }
        }
        for (x, column) in columns.iter_mut().enumerate() {
            *column *= overlap(low.x, high.x, x, table.nx);
        }
        columns
    }

    /// The density at `p` within a window; 0 where the window holds nothing.
    pub(crate) fn pdf(&self, p: DVec2, [low, high]: [DVec2; 2]) -> f64 {
        let integral = self.integral(low, high);
        let is_inside = p.cmpge(low).all() && p.cmple(high).all();
        if integral > 0.0 && is_inside {
            self.0.weights[self.0.texel(p)] / integral
        } else {
            0.0
        }
    }

    /// The point of a window for `u`: the first number picks x, the second one y within the column
    /// of texels there.
    pub(crate) fn sample(&self, u: DVec2, [low, high]: [DVec2; 2]) -> Option<DVec2> {
        let table = &self.0;
        let (column, part) = pick(&self.columns([low, high]), u.x)?;
        let x = within(low.x, high.x, column, table.nx, part);
        let texels: Vec<f64> = (0..table.ny)
            .map(|y| overlap(low.y, high.y, y, table.ny) * table.weights[column + table.nx * y])
            .collect();
        let (row, part) = pick(&texels, u.y)?;
        Some(DVec2::new(x, within(low.y, high.y, row, table.ny, part)))
    }
}

/// How much of texel `i` of `n` lies between two coordinates.
fn overlap(low: f64, high: f64, i: usize, n: usize) -> f64 {
    let (left, right) = (i as f64 / n as f64, (i + 1) as f64 / n as f64);
    (high.min(right) - low.max(left)).max(0.0)
}

/// The coordinate at `part` of what lies of texel `i` between two coordinates.
fn within(low: f64, high: f64, i: usize, n: usize, part: f64) -> f64 {
    let (left, right) = (i as f64 / n as f64, (i + 1) as f64 / n as f64);
    let (left, right) = (low.max(left), high.min(right));
    left + part * (right - left)
}

/// Which weight the part `u` of their sum falls into, and where in it; none if all are zero.
fn pick(weights: &[f64], u: f64) -> Option<(usize, f64)> {
    let sum: f64 = weights.iter().sum();
    let target = u * sum;
    let mut before = 0.0;
    let mut last = None;
    for (i, &weight) in weights.iter().enumerate().filter(|(_, w)| **w > 0.0) {
        if before + weight > target {
            return Some((i, (target - before) / weight));
        }
        before += weight;
        last = Some((i, 1.0));
    }
    last
}
