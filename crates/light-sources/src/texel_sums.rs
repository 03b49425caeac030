use alloc::vec;
use alloc::vec::Vec;

use crate::glam::Vec2;
use crate::parallel::map_rows;
use crate::rgb_sum::single;
use light_math::float::ONE_MINUS_EPSILON;

/// Texels of a grid in proportion to weights, by running sums alone: 4 bytes a texel and 4 a row.
///
/// A query of the density computes the weight of the texel again.
#[derive(Clone, Debug)]
pub(crate) struct TexelSums {
    /// What lies before each texel in its row, as a share of the row.
    rows: Vec<f32>,
    /// What lies before each row, as a share of all.
    marginal: Vec<f32>,
}

/// A place in a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TexelPlace {
    /// Column and row.
    pub(crate) texel: [u32; 2],
    /// The place in the texel, in `[0, 1]^2`.
    pub(crate) place: Vec2,
}

impl TexelSums {
    /// The sums over an image, with the mean weight; `None` if all weights are zero. And what
    /// `weigh` learns of each row.
    ///
    /// `weigh` writes the weights of a row, finite and not negative, and returns their total;
    /// `shares` are the sizes of a texel, by row. Rows are independent of each other, so that the
    /// sums do not depend on the number of threads.
    pub(crate) fn new<T: Send>(
        [width, height]: [u32; 2],
        shares: &[f64],
        weigh: impl Fn(u32, &mut [f32]) -> (f64, T) + Send + Sync,
    ) -> (Option<(Self, f64)>, Vec<T>) {
        let mut rows = vec![0.0; width as usize * height as usize];
        let (totals, results): (Vec<f64>, Vec<T>) =
            map_rows(&mut rows, width as usize, |y, row| {
                let (total, result) = weigh(y, row);
                accumulate(row, total);
                (total, result)
            })
            .into_iter()
            .unzip();
        let weights = totals.iter().zip(shares).map(|(row, share)| row * share);
        let total: f64 = weights.clone().sum();
        if !(total > 0.0) {
            return (None, results);
        }
        let mut before = 0.0;
        let marginal = weights
            .map(|weight| {
                let share = single(before / total);
                before += weight;
                share
            })
            .collect();
        (Some((Self { rows, marginal }, total)), results)
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val::<[f32]>(&self.rows) + size_of_val::<[f32]>(&self.marginal)
    }

    /// What lies before each texel in its row, row by row, and what lies before each row.
    pub(crate) fn shares(&self) -> [&[f32]; 2] {
        [&self.rows, &self.marginal]
    }

    /// The place for `u` in `[0, 1)^2`: `u.y` picks the row, `u.x` the place in it.
    #[inline]
    pub(crate) fn sample(&self, u: Vec2) -> TexelPlace {
        let (row, y) = find(&self.marginal, u.y);
        let width = self.rows.len() / self.marginal.len();
        let (column, x) = find(&self.rows[row * width..][..width], u.x);
        #[expect(clippy::cast_possible_truncation, reason = "sizes are u32")]
        TexelPlace {
            texel: [column as u32, row as u32],
            place: Vec2::new(x, y),
        }
    }
}

/// Turns weights into what lies before each, as a share of their total.
fn accumulate(row: &mut [f32], total: f64) {
    if !(total > 0.0) {
        return;
    }
    let inv_total = 1.0 / total;
    let mut before = 0.0;
    for sum in row {
        let weight = f64::from(*sum);
        *sum = single(before * inv_total);
        before += weight;
    }
}

/// The bin for `u`, one with a width, and the place in it in `[0, 1]`. The last bin ends at 1.
#[inline]
fn find(sums: &[f32], u: f32) -> (usize, f32) {
    let u = if u > 0.0 {
        u.min(ONE_MINUS_EPSILON)
    } else {
        0.0
    };
    let bin = sums.partition_point(|&sum| sum <= u).saturating_sub(1);
    let end = sums.get(bin + 1).copied().unwrap_or(1.0);
    (bin, (u - sums[bin]) / (end - sums[bin]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(weights: &[f32], width: u32, shares: &[f64]) -> Option<(TexelSums, f64)> {
        let size = [width, u32::try_from(shares.len()).expect("few rows")];
        let weigh = |y: u32, row: &mut [f32]| {
            row.copy_from_slice(&weights[(y * width) as usize..][..width as usize]);
            (row.iter().copied().map(f64::from).sum(), ())
        };
        TexelSums::new(size, shares, weigh).0
    }

    #[test]
    fn texels_are_found_by_weight_times_size() {
        let (sums, total) = table(&[0.0, 1.0, 3.0, 0.0, 0.0, 2.0], 3, &[0.25, 0.5]).expect("light");
        assert_eq!(total, 2.0, "of both rows");
        let at = |x, y| {
            let TexelPlace { texel, place } = sums.sample(Vec2::new(x, y));
            (texel, place.x, place.y)
        };
        assert_eq!(at(0.125, 0.25), ([1, 0], 0.5, 0.5), "within a texel");
        assert_eq!(at(0.25, 0.0), ([2, 0], 0.0, 0.0), "at its edge");
        assert_eq!(at(0.5, 0.75), ([2, 1], 0.5, 0.5), "the only one of a row");
        for edge in [0.0, f32::NAN, ONE_MINUS_EPSILON, 1.0, 7.0] {
            let (texel, x, y) = at(edge, edge);
            assert!(
                [[1, 0], [2, 1]].contains(&texel),
                "lit for {edge}: {texel:?}"
            );
            assert!(
                (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y),
                "{x} {y}"
            );
        }
    }

    #[test]
    fn dark_ends_are_never_reached() {
        let mut weights = [0.0; 100];
        for (i, weight) in weights[33..67].iter_mut().enumerate() {
            *weight = 0.1 + i as f32 / 7.0;
        }
        let (sums, _) = table(&weights, 10, &[0.1; 10]).expect("light");
        for u in [0.0, 1e-9, 0.5, 0.999_999_9, ONE_MINUS_EPSILON] {
            let [x, y] = sums.sample(Vec2::splat(u)).texel.map(|i| i as usize);
            assert!(weights[10 * y + x] > 0.0, "texel {x} {y} for {u}");
        }
        assert!(table(&[0.0; 4], 2, &[1.0; 2]).is_none(), "black");
    }
}
