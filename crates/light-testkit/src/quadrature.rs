/// Nodes and weights that integrate polynomials up to degree `2 n - 1` exactly over `[-1, 1]`.
#[derive(Clone, Debug)]
pub struct GaussLegendre {
    nodes: Vec<(f64, f64)>,
}

impl GaussLegendre {
    /// The rule with `n >= 1` nodes, each the limit of Newton's method on the Legendre polynomial.
    ///
    /// # Source
    /// `[DLMF]`, 3.5(v), with the weights of 3.5.24.
    #[must_use]
    pub fn new(n: usize) -> Self {
        let nodes = (0..n).map(|i| node(n, i)).collect();
        Self { nodes }
    }

    /// The integral of `f` over `[a, b]`.
    pub fn integrate(&self, a: f64, b: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let sum = self.nodes.iter().map(|&(x, w)| w * f(middle + half * x));
        half * sum.sum::<f64>()
    }

    /// The integral of `f` over the box from `low` to `high`, with the rule along each axis.
    pub fn integrate_box<const D: usize>(
        &self,
        low: [f64; D],
        high: [f64; D],
        mut f: impl FnMut([f64; D]) -> f64,
    ) -> f64 {
        let n = self.nodes.len();
        let mut sum = 0.0;
        for index in 0..n.pow(D as u32) {
            let (mut rest, mut weight, mut x) = (index, 1.0, [0.0; D]);
            for axis in 0..D {
                let (node, w) = self.nodes[rest % n];
                let half = 0.5 * (high[axis] - low[axis]);
                x[axis] = low[axis] + half * (1.0 + node);
                weight *= w * half;
                rest /= n;
            }
            sum += weight * f(x);
        }
        sum
    }
}

/// The integral of `f` over the box from `low` to `high`, with an absolute error of about
/// `tolerance`.
///
/// A box is halved along every axis until both sides agree, at least twice and at most twelve
/// times: jumps of `f` cost time, not correctness. Features narrower than a thirtieth of the box
/// can be missed, so choose boxes that fit them.
pub fn integrate<const D: usize>(
    low: [f64; D],
    high: [f64; D],
    tolerance: f64,
    mut f: impl FnMut([f64; D]) -> f64,
) -> f64 {
    const MIN_DEPTH: u32 = 2;
    const MAX_DEPTH: u32 = 12;
    // The errors of four parts have random signs, so they add up to about two of them.
    const SHARE: f64 = 0.5;
    let rule = GaussLegendre::new(4);
    let first = rule.integrate_box(low, high, &mut f);
    let mut stack = vec![(low, high, first, tolerance, 0)];
    let mut total = 0.0;
    while let Some((low, high, coarse, tolerance, depth)) = stack.pop() {
        let parts: Vec<_> = (0..1usize << D)
            .map(|corner| {
                let (low, high) = sub_box(low, high, corner);
                let value = rule.integrate_box(low, high, &mut f);
                (low, high, value, tolerance * SHARE, depth + 1)
            })
            .collect();
        let fine: f64 = parts.iter().map(|part| part.2).sum();
        let agrees = depth >= MIN_DEPTH && (fine - coarse).abs() <= tolerance;
        if agrees || depth == MAX_DEPTH {
            total += fine;
        } else {
            stack.extend(parts);
        }
    }
    total
}

/// Root number `i` of the Legendre polynomial of degree `n`, and its weight.
fn node(n: usize, i: usize) -> (f64, f64) {
    let n = n as f64;
    let mut x = (core::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
    let mut slope = 0.0;
    for _ in 0..100 {
        let (mut p0, mut p1) = (1.0, x);
        let mut k = 1.0;
        while k < n {
            (p0, p1) = (p1, ((2.0 * k + 1.0) * x * p1 - k * p0) / (k + 1.0));
            k += 1.0;
        }
        slope = n * (x * p1 - p0) / (x * x - 1.0);
        let step = p1 / slope;
        x -= step;
        if step.abs() < 1e-15 {
            break;
        }
    }
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

/// The part of a box, halved along every axis, that bit `axis` of `corner` puts in the upper half.
fn sub_box<const D: usize>(low: [f64; D], high: [f64; D], corner: usize) -> ([f64; D], [f64; D]) {
    let (mut sub_low, mut sub_high) = (low, high);
    for axis in 0..D {
        let middle = 0.5 * (low[axis] + high[axis]);
        if corner >> axis & 1 == 1 {
            sub_low[axis] = middle;
        } else {
            sub_high[axis] = middle;
        }
    }
    (sub_low, sub_high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_exact_for_polynomials() {
        for n in 1..20 {
            let rule = GaussLegendre::new(n);
            let degree = 2 * n as i32 - 2;
            let integral = rule.integrate(-1.0, 1.0, |x| x.powi(degree));
            let exact = 2.0 / f64::from(degree + 1);
            assert!((integral - exact).abs() < 1e-13, "{n} nodes: {integral}");
        }
    }

    #[test]
    fn adaptive_integrals_in_one_two_and_three_dimensions() {
        let line = integrate([0.0], [1.0], 1e-10, |[x]| x.sqrt());
        assert!((line - 2.0 / 3.0).abs() < 1e-6, "square root: {line}");
        let square = integrate([0.0; 2], [1.0, 2.0], 1e-10, |[x, y]| x * y * y);
        assert!((square - 4.0 / 3.0).abs() < 1e-12, "polynomial: {square}");
        let cube = integrate([0.0; 3], [1.0; 3], 1e-8, |[x, y, z]| (x + y + z).exp());
        assert!((cube - (1f64.exp() - 1.0).powi(3)).abs() < 1e-7, "{cube}");
    }

    #[test]
    fn a_jump_costs_time_not_correctness() {
        let disk = integrate([-1.0; 2], [1.0; 2], 1e-4, |[x, y]| {
            f64::from(x * x + y * y < 1.0)
        });
        assert!((disk - core::f64::consts::PI).abs() < 1e-3, "area {disk}");
    }
}
