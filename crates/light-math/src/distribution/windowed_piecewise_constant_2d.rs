use super::piecewise_constant_2d::Sample2D;
use super::position::texel;
use super::quotient::quotient;
use super::span::Span;
use super::summed_area_table::SummedAreaTable;
use super::window::Window;
use glam::Vec2;

/// The density of a [`PiecewiseConstant2D`](super::PiecewiseConstant2D) over the unit square,
/// restricted to any rectangle of it: how an environment is sampled through a window.
///
/// Values of texels are differences of the table's sums, so nothing else is stored. A sample costs
/// a binary search over the columns and one over the rows.
///
/// Sums over a window are whole numbers of 128 bits, for its edges are counted in 2^-32 of a texel:
/// nothing cancels, and no query has a 64-bit float. Each result is rounded once; `u` counts to
/// 2^-32.
///
/// # Source
/// `[Bitterli2015]`. `u.x` picks x first, then `u.y` picks y within the texel's column, as in
/// `[PBRT4]` A.5.6; there by bisection of the interpolated sums, here by search over texels and a
/// straight line within the one that is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowedPiecewiseConstant2D<S> {
    table: SummedAreaTable<S>,
}

impl<S: AsRef<[u64]>> WindowedPiecewiseConstant2D<S> {
    /// The density proportional to the weights that `table` sums.
    #[must_use]
    pub const fn new(table: SummedAreaTable<S>) -> Self {
        Self { table }
    }

    /// The point of `window` for `u` in `[0, 1)^2`; `None` if the window holds no weight.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: Vec2, window: &Window) -> Option<Sample2D> {
        let spans = self.table.spans(&window.clip()?);
        let [columns, rows] = &spans;
        let x = columns.choose(u.x, |x| self.table.sum_below(x, rows))?;
        let column = |y| self.table.below(x.texel + 1, y) - self.table.below(x.texel, y);
        let y = rows.choose(u.y, column)?;
        let texel = [x.texel, y.texel];
        let pdf = self.density(texel, &spans, x.total);
        let p = Vec2::new(x.x, y.x);
        (pdf > 0.0).then_some(Sample2D { p, pdf, texel })
    }

    /// The density of [`sample`](Self::sample) at `p`, per area; 0 outside `window`.
    #[inline]
    #[must_use]
    pub fn pdf(&self, p: Vec2, window: &Window) -> f32 {
        let Some(window) = window.clip().filter(|window| window.contains(p)) else {
            return 0.0;
        };
        let [nx, ny] = self.table.resolution();
        let spans = self.table.spans(&window);
        let total = self.table.total(&spans);
        self.density([texel(p.x, nx), texel(p.y, ny)], &spans, total)
    }

    /// The table of sums.
    #[must_use]
    pub const fn table(&self) -> &SummedAreaTable<S> {
        &self.table
    }

    /// The density in a texel, given the window and its sum; 0 for an empty window.
    #[inline]
    fn density(&self, [column, row]: [usize; 2], [x, y]: &[Span; 2], total: u128) -> f32 {
        if total == 0 {
            return 0.0;
        }
        let value = self.table.count(column..column + 1, row..row + 1);
        let [nx, ny] = self.table.resolution();
        let value = u128::from(value) * (nx as u64 * ny as u64) as u128;
        quotient(value, total, x.log2_steps() + y.log2_steps())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::float::ONE_MINUS_EPSILON;
    use alloc::vec::Vec;

    fn table(weights: &[f32], nx: usize, ny: usize) -> WindowedPiecewiseConstant2D<Vec<u64>> {
        WindowedPiecewiseConstant2D::new(
            SummedAreaTable::new(weights, nx, ny).expect("valid weights"),
        )
    }

    #[test]
    fn fixed_points() {
        let table = table(&[1.0, 0.0, 2.0, 4.0, 0.0, 5.0], 3, 2);
        let s = table
            .sample(Vec2::new(0.25, 0.6), &Window::UNIT)
            .expect("weights");
        assert_eq!(s.texel, [0, 1], "column by u.x, row by u.y");
        assert!((s.pdf - 2.0).abs() < 1e-6, "4 over the mean 2");
        let left = Window::new(Vec2::ZERO, Vec2::new(0.5, 0.5));
        let s = table.sample(Vec2::new(0.5, 0.5), &left).expect("weights");
        assert!(
            s.p.distance(Vec2::new(1.0 / 6.0, 0.25)) < 1e-6,
            "middle of the only texel"
        );
        assert!(
            (s.pdf - 6.0).abs() < 1e-6,
            "even over a sixth of the square"
        );
        let gap = Window::new(Vec2::new(0.34, 0.0), Vec2::new(0.66, 1.0));
        assert_eq!(
            table.sample(Vec2::splat(0.5), &gap),
            None,
            "nothing in the window"
        );
        assert_eq!(
            table.pdf(Vec2::splat(0.5), &gap),
            0.0,
            "nothing in the window"
        );
        assert_eq!(
            table.pdf(Vec2::splat(0.9), &left),
            0.0,
            "outside the window"
        );
    }

    #[test]
    fn samples_stay_in_the_window_and_where_there_is_density() {
        let checkered: Vec<f32> = (0..63u8)
            .map(|i| f32::from(i % 2) * 0.7f32.powi(i.into()))
            .collect();
        let table = table(&checkered, 7, 9);
        let ends = [
            0.0,
            1e-30,
            0.1,
            1.0 / 7.0,
            0.333_333_34,
            0.5,
            0.857_142_9,
            0.999_999_94,
            1.0,
        ];
        let us = [0.0, 0.3, 0.5, 0.77, ONE_MINUS_EPSILON, f32::NAN, 2.0];
        let mut taken = 0;
        for (i, &x0) in ends.iter().enumerate() {
            for &x1 in &ends[i + 1..] {
                let window = Window::new(Vec2::new(x0, 0.0), Vec2::new(x1, 0.9));
                for (k, &u) in us.iter().enumerate() {
                    let Some(s) = table.sample(Vec2::new(u, us[us.len() - 1 - k]), &window) else {
                        continue;
                    };
                    taken += 1;
                    assert!(window.contains(s.p), "{s:?} in {window:?}");
                    assert!(
                        s.pdf > 0.0 && s.pdf == table.pdf(s.p, &window),
                        "density of {s:?}"
                    );
                }
            }
        }
        assert!(taken > 200, "{taken} of 252");
    }

    /// 0.7 as `f32` is below seven tenths, so in the texel before.
    #[test]
    fn samples_at_the_start_of_a_texel_lie_in_it() {
        let weights = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0];
        let table = table(&weights, 10, 1);
        let s = table.sample(Vec2::ZERO, &Window::UNIT).expect("a weight");
        assert_eq!(s.texel, [7, 0], "{s:?}");
        let next = f32::from_bits(0.7f32.to_bits() + 1);
        assert_eq!((s.p.x, s.pdf), (next, 10.0), "one step up");
        assert_eq!(table.pdf(s.p, &Window::UNIT), s.pdf, "{s:?}");
    }

    #[test]
    fn nonsense_windows_hold_nothing() {
        let table = table(&[1.0; 4], 2, 2);
        let u = Vec2::splat(0.5);
        for (min, max) in [(0.5, 0.5), (0.7, 0.3), (f32::NAN, 1.0), (2.0, 3.0)] {
            let window = Window::new(Vec2::splat(min), Vec2::splat(max));
            assert_eq!(table.sample(u, &window), None, "{window:?}");
            assert_eq!(table.pdf(u, &window), 0.0, "{window:?}");
        }
        let wide = Window::new(Vec2::splat(-1.0), Vec2::splat(9.0));
        let s = table.sample(u, &wide).expect("the square");
        assert_eq!((s.p, s.pdf), (u, 1.0), "cut off at the unit square");
    }
}
