//! Naive twins, with which optimised code must agree: written as directly as possible, in `f64`.

use light_math::glam::Vec3;

use crate::real3::{cross, dot, normalize, real3, sub};

/// A choice made by walking along the weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Which weight was hit.
    pub index: usize,
    /// Its share of the sum.
    pub pmf: f64,
    /// Where in the share `u` fell, in `[0, 1)`.
    pub u: f64,
}

/// The entry of `weights` (none negative) at which the running share of the sum passes `u` in
/// `[0, 1)`.
///
/// `None` when all weights are zero. Never returns an entry of zero weight.
#[must_use]
pub fn choose(weights: &[f64], u: f64) -> Option<Choice> {
    let sum: f64 = weights.iter().sum();
    let mut rest = u * sum;
    let mut last = None;
    for (index, &weight) in weights.iter().enumerate().filter(|(_, w)| **w > 0.0) {
        let choice = Choice {
            index,
            pmf: weight / sum,
            u: (rest / weight).clamp(0.0, 1.0 - f64::EPSILON / 2.0),
        };
        if rest < weight {
            return Some(choice);
        }
        last = Some(choice);
        rest -= weight;
    }
    last
}

/// The density with respect to `x` in `[0, 1)` of the function that has the constant `func[i]` on
/// each of the equal cells, normalised; 0 when the function is zero.
#[must_use]
pub fn piecewise_constant_pdf(func: &[f64], x: f64) -> f64 {
    let sum: f64 = func.iter().sum();
    let cell = ((x * func.len() as f64) as usize).min(func.len() - 1);
    if sum > 0.0 {
        func[cell] * func.len() as f64 / sum
    } else {
        0.0
    }
}

/// The `x` in `[0, 1)` at which the integral of that function reaches the share `u`; `None` when it
/// is zero.
#[must_use]
pub fn piecewise_constant_sample(func: &[f64], u: f64) -> Option<f64> {
    let choice = choose(func, u)?;
    Some((choice.index as f64 + choice.u) / func.len() as f64)
}

/// The sum of `values` (rows of `width`) over the columns `x0..x1` and the rows `y0..y1`.
#[must_use]
pub fn rectangle_sum(
    values: &[f64],
    width: usize,
    [x0, x1]: [usize; 2],
    [y0, y1]: [usize; 2],
) -> f64 {
    let row = |y: usize| values[y * width + x0..y * width + x1].iter().sum::<f64>();
    (y0..y1).map(row).sum()
}

/// The integral of `f` over the unit square by midpoints of `n` by `n` cells.
pub fn integrate_square(n: u32, mut f: impl FnMut([f64; 2]) -> f64) -> f64 {
    let step = 1.0 / f64::from(n);
    let middle = |i: u32| (f64::from(i) + 0.5) * step;
    let cells = (0..n * n).map(|cell| f([middle(cell % n), middle(cell / n)]));
    cells.sum::<f64>() * step * step
}

/// The cosine between `-wi` and the counter-clockwise normal where the ray from `p` along `wi`
/// meets the triangle; `None` when it misses.
#[must_use]
pub fn hit_triangle(p: Vec3, wi: Vec3, corners: [Vec3; 3]) -> Option<f64> {
    let wi = real3(wi);
    let [a, b, c] = corners.map(|corner| sub(real3(corner), real3(p)));
    // The ray passes all three edges on the same side.
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| dot(wi, cross(from, to)));
    let inside = sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0);
    let normal = normalize(cross(sub(b, a), sub(c, a)));
    let cos = -dot(wi, normal);
    let ahead = -dot(a, normal) * cos > 0.0;
    (inside && ahead).then_some(cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_skip_zero_weights_and_reach_the_last() {
        let weights = [0.0, 1.0, 0.0, 3.0, 0.0];
        let low = choose(&weights, 0.0);
        assert_eq!(
            low,
            Some(Choice {
                index: 1,
                pmf: 0.25,
                u: 0.0
            }),
            "low end"
        );
        let high = choose(&weights, 1.0 - f64::EPSILON / 2.0);
        assert_eq!(high.map(|c| c.index), Some(3), "high end");
        assert_eq!(
            choose(&weights, 0.625).map(|c| c.u),
            Some(0.5),
            "unused part"
        );
        assert_eq!(choose(&[0.0; 3], 0.5), None, "nothing to choose");
    }

    #[test]
    fn piecewise_constant_functions() {
        let func = [1.0, 3.0];
        assert_eq!(piecewise_constant_pdf(&func, 0.75), 1.5, "density");
        assert_eq!(
            piecewise_constant_sample(&func, 0.625),
            Some(0.75),
            "sample"
        );
        assert_eq!(piecewise_constant_pdf(&[0.0], 0.5), 0.0, "zero function");
    }

    #[test]
    fn sums_over_rectangles() {
        let values = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        assert_eq!(
            rectangle_sum(&values, 3, [1, 3], [0, 2]),
            16.0,
            "2 + 3 + 5 + 6"
        );
        let mean = integrate_square(100, |[x, y]| x + y);
        assert!((mean - 1.0).abs() < 1e-12, "mean of x + y: {mean}");
    }

    #[test]
    fn rays_and_triangles() {
        let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let from = Vec3::new(0.2, 0.2, 2.0);
        assert_eq!(
            hit_triangle(from, Vec3::NEG_Z, triangle),
            Some(1.0),
            "front"
        );
        assert_eq!(hit_triangle(-from, Vec3::Z, triangle), None, "beside");
        assert_eq!(
            hit_triangle(from, Vec3::Z, triangle),
            None,
            "behind the ray"
        );
        let below = Vec3::new(0.2, 0.2, -2.0);
        assert_eq!(hit_triangle(below, Vec3::Z, triangle), Some(-1.0), "back");
    }
}
