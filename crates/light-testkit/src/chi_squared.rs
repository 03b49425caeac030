use crate::{SIGNIFICANCE, regularized_gamma_q};

/// What Pearson's test says about observed counts.
#[derive(Clone, Copy, Debug)]
pub struct ChiSquared {
    /// Sum of `(observed - expected)^2 / expected`.
    pub statistic: f64,
    /// Degrees of freedom: pooled cells minus one.
    pub degrees: usize,
    /// The chance of a statistic this large when the counts follow the expectation.
    pub p_value: f64,
}

impl ChiSquared {
    /// Whether the counts pass at [`SIGNIFICANCE`], divided by the number of tests that one check consists of.
    #[must_use]
    pub fn passes(&self, tests: usize) -> bool {
        self.p_value >= SIGNIFICANCE / tests.max(1) as f64
    }
}

/// Compares observed counts with expected ones, cell by cell; both slices have one entry a cell.
///
/// The expected counts should sum to the number of samples. Cells that expect fewer than five are pooled, smallest
/// first, as the distribution of the statistic is only known for well filled cells.
///
/// # Source
/// `[DLMF]`, 8.2.4: the survival function of the chi-squared distribution is an incomplete gamma function.
#[must_use]
pub fn chi_squared(observed: &[u64], expected: &[f64]) -> ChiSquared {
    const SMALLEST_CELL: f64 = 5.0;
    debug_assert_eq!(observed.len(), expected.len(), "one expectation a cell");
    let mut cells: Vec<(f64, f64)> = expected
        .iter()
        .zip(observed)
        .map(|(&e, &o)| (e.max(0.0), o as f64))
        .collect();
    cells.sort_by(|a, b| a.0.total_cmp(&b.0));

    let (mut statistic, mut pooled) = (0.0, 0);
    let mut pool = (0.0, 0.0);
    let mut close = |(e, o): (f64, f64)| {
        // A pool that stays too small enters with a smaller weight, so that only a flagrant contradiction shows.
        statistic += (o - e) * (o - e) / e.max(SMALLEST_CELL);
        pooled += 1;
    };
    for (e, o) in cells {
        if e >= SMALLEST_CELL {
            close((e, o));
            continue;
        }
        pool = (pool.0 + e, pool.1 + o);
        if pool.0 >= SMALLEST_CELL {
            close(core::mem::take(&mut pool));
        }
    }
    if pool != (0.0, 0.0) {
        close(pool);
    }
    let degrees = usize::max(pooled, 2) - 1;
    ChiSquared {
        statistic,
        degrees,
        p_value: chi_squared_survival(degrees, statistic),
    }
}

/// The chance that a chi-squared variable with this many degrees of freedom exceeds `x`.
#[must_use]
pub fn chi_squared_survival(degrees: usize, x: f64) -> f64 {
    regularized_gamma_q(0.5 * degrees as f64, 0.5 * x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    #[test]
    fn survival_at_tabulated_quantiles() {
        // NIST/SEMATECH e-Handbook, 1.3.6.7.4: upper critical values.
        for (degrees, x, p) in [(1, 3.841, 0.05), (10, 18.307, 0.05), (100, 149.449, 0.001)] {
            let survival = chi_squared_survival(degrees, x);
            assert!(
                (survival - p).abs() < 1e-3 * p.sqrt(),
                "{degrees}: {survival}"
            );
        }
    }

    #[test]
    fn fair_dice_pass_and_loaded_dice_fail() {
        let mut rng = Rng::new(5);
        let mut counts = [0u64; 6];
        (0..60_000).for_each(|_| counts[rng.below(6)] += 1);
        assert!(chi_squared(&counts, &[10_000.0; 6]).passes(1), "fair");
        counts[0] += 900;
        assert!(!chi_squared(&counts, &[10_150.0; 6]).passes(1), "loaded");
    }

    #[test]
    fn counts_in_impossible_cells_fail() {
        let outcome = chi_squared(&[500, 500, 100], &[550.0, 550.0, 0.0]);
        assert!(
            !outcome.passes(1),
            "a cell that expects nothing: {outcome:?}"
        );
    }
}
