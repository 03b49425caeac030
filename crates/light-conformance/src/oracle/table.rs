//! Piecewise-constant densities, by sums in double precision.

use super::Jitter;
use lights::math::glam::DVec2;

/// How far running sums in single precision move the random numbers.
const SUMS: f64 = 8.0 * f32::EPSILON as f64;

/// A density on the unit square that is constant in each texel; zero everywhere if all weights are.
#[derive(Clone, Debug)]
pub(crate) struct ExactTable {
    pub(crate) nx: usize,
    pub(crate) ny: usize,
    pub(crate) weights: Vec<f64>,
}

impl ExactTable {
    /// The mean of all weights.
    pub(crate) fn mean(&self) -> f64 {
        self.weights.iter().sum::<f64>() / self.weights.len() as f64
    }

    /// The texel of a point.
    pub(crate) fn texel(&self, p: DVec2) -> usize {
        let index = |x: f64, n: usize| ((x * n as f64).max(0.0) as usize).min(n - 1);
        index(p.x, self.nx) + self.nx * index(p.y, self.ny)
    }

    /// The density per area of the square.
    pub(crate) fn pdf(&self, p: DVec2) -> f64 {
        let mean = self.mean();
        if mean > 0.0 {
            self.weights[self.texel(p)] / mean
        } else {
            0.0
        }
    }

    /// Whether rounding of the sums may lead anywhere in bin `i` of the first row.
    pub(crate) fn is_narrow(&self, i: usize) -> bool {
        let row = &self.weights[..self.nx];
        row[i] <= 2.0 * SUMS * row.iter().sum::<f64>()
    }

    /// The point for `u` in a texel, and its density there; none if the sums of no rounding lead
    /// there.
    pub(crate) fn sample_in(
        &self,
        u: DVec2,
        [ix, iy]: [usize; 2],
        jitter: &mut Jitter,
    ) -> Option<(DVec2, f64)> {
        let rows: Vec<f64> = self
            .weights
            .chunks(self.nx)
            .map(|r| r.iter().sum())
            .collect();
        let row = self.weights.get(iy * self.nx..)?.get(..self.nx)?;
        let y = place_in(&rows, u.y, iy, jitter)?;
        let x = place_in(row, u.x, ix, jitter)?;
        Some((DVec2::new(x, y), row[ix] / self.mean()))
    }

    /// The point for `u`: the second number picks the row, the first one the place in it.
    pub(crate) fn sample(&self, u: DVec2, jitter: &mut Jitter) -> Option<DVec2> {
        let rows: Vec<f64> = self
            .weights
            .chunks(self.nx)
            .map(|row| row.iter().sum())
            .collect();
        let y = place(&rows, jitter.by(u.y, SUMS))?;
        let iy = ((y * self.ny as f64) as usize).min(self.ny - 1);
        let row = &self.weights[iy * self.nx..][..self.nx];
        Some(DVec2::new(place(row, jitter.by(u.x, SUMS))?, y))
    }
}

/// The place in bin `i` for `u`, anywhere in it if it is narrower than rounding; none if `u` is not
/// even near.
fn place_in(weights: &[f64], u: f64, i: usize, jitter: &mut Jitter) -> Option<f64> {
    let sum: f64 = weights.iter().sum();
    let low = weights[..i].iter().sum::<f64>() / sum;
    let width = weights[i] / sum;
    let is_near = low - SUMS <= u && u <= low + width + SUMS;
    let part = ((jitter.by(u, SUMS) - low) / width).clamp(0.0, 1.0);
    (width > 0.0 && is_near).then(|| (i as f64 + part) / weights.len() as f64)
}

/// The place in [0, 1] below which there is the part `u` of the weights; none if all are zero.
pub(crate) fn place(weights: &[f64], u: f64) -> Option<f64> {
    let sum: f64 = weights.iter().sum();
    if sum <= 0.0 {
        return None;
    }
    let target = u.clamp(0.0, 1.0) * sum;
    let mut before = 0.0;
    let mut last = 0.0;
    for (i, &weight) in weights.iter().enumerate() {
        if weight > 0.0 {
            last = (i + 1) as f64;
            if before + weight > target {
                return Some((i as f64 + (target - before) / weight) / weights.len() as f64);
            }
        }
        before += weight;
    }
    Some(last / weights.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_by_hand() {
        let weights = [0.0, 3.0, 0.0, 1.0];
        let at = |u: f64| place(&weights, u).expect("not all zero");
        assert_eq!(
            [0.0, 0.375, 0.75, 0.875].map(at),
            [0.25, 0.375, 0.75, 0.875],
            "of [0, 3, 0, 1]"
        );
        assert_eq!(place(&[0.0; 3], 0.5), None, "nothing");
    }
}
