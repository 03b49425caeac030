use crate::{SIGNIFICANCE, regularized_gamma_q, significance};

/// Cells that expect less are pooled.
const SMALLEST_CELL: f64 = 5.0;

/// The result of Pearson's test of observed counts.
#[derive(Clone, Copy, Debug)]
pub struct ChiSquared {
    /// Sum over cells of `(observed - expected)^2 / expected`, or of the likelihood ratio's term
    /// where that is smaller.
    pub statistic: f64,
    /// Degrees of freedom: pooled cells minus one.
    pub degrees: usize,
    /// The chance of a statistic this large when the counts follow the expectation.
    pub p_value: f64,
}

impl ChiSquared {
    /// Whether the counts pass at [`SIGNIFICANCE`].
    #[must_use]
    pub fn passes(&self) -> bool {
        self.p_value >= SIGNIFICANCE
    }
}

/// Compares observed counts with expected ones, cell by cell; both slices have one entry a cell.
///
/// The expected counts should sum to the number of samples. Cells that expect fewer than five are
/// pooled, smallest first, as the distribution of the statistic is only known for well filled
/// cells.
///
/// Levels as small as [`SIGNIFICANCE`] lie far out in the tail, where Pearson's term of a scarce
/// cell is much too large: a Poisson variable of mean 5 is six standard deviations above it ten
/// thousand times as often as a normal one. The likelihood ratio's term `2 (o ln(o / e) - o + e)`
/// decays as the Poisson tail does, so the smaller of both is taken.
///
/// # Source
/// `[DLMF]`, 8.2.4: the survival function of the chi-squared distribution is an incomplete gamma
/// function.
#[must_use]
pub fn chi_squared(observed: &[u64], expected: &[f64]) -> ChiSquared {
    debug_assert_eq!(observed.len(), expected.len(), "one expectation a cell");
    let mut cells: Vec<(f64, f64)> = expected
        .iter()
        .zip(observed)
        .map(|(&e, &o)| (e.max(0.0), o as f64))
        .collect();
    cells.sort_by(|a, b| a.0.total_cmp(&b.0));

    significance::take();
    let (mut statistic, mut pooled) = (0.0, 0);
    let mut pool = (0.0, 0.0);
    let mut close = |(e, o): (f64, f64)| {
        statistic += term(e, o);
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

/// The term of a cell that expects `e` and observes `o`.
fn term(e: f64, o: f64) -> f64 {
    // A pool that stays too small enters with a smaller weight, so that only a large excess
    // fails.
    let pearson = (o - e) * (o - e) / e.max(SMALLEST_CELL);
    let of_counts = if o > 0.0 { o * (o / e).ln() } else { 0.0 };
    pearson.min(2.0 * (of_counts - o + e))
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
        assert!(chi_squared(&counts, &[10_000.0; 6]).passes(), "fair");
        counts[0] += 900;
        assert!(!chi_squared(&counts, &[10_150.0; 6]).passes(), "loaded");
    }

    /// A lone cell of Poisson counts fails at about the stated level, however scarce it is: by
    /// Pearson's term alone, one that expects 5 would fail ten thousand times as often.
    #[test]
    fn scarce_cells_keep_the_level() {
        for expected in [5.0, 7.5, 20.0, 100.0, 1000.0] {
            let ln_pmf = |k: f64| k * f64::ln(expected) - expected - crate::ln_gamma(k + 1.0);
            let fails =
                |k: &i32| chi_squared_survival(1, term(expected, f64::from(*k))) < SIGNIFICANCE;
            let false_alarms: f64 = (0..4000)
                .filter(fails)
                .map(|k| ln_pmf(f64::from(k)).exp())
                .sum();
            assert!(
                false_alarms < 3.0 * SIGNIFICANCE,
                "{expected}: {false_alarms}"
            );
        }
    }

    #[test]
    fn counts_in_impossible_cells_fail() {
        let outcome = chi_squared(&[500, 500, 100], &[550.0, 550.0, 0.0]);
        assert!(
            !outcome.passes(),
            "a cell that expects nothing: {outcome:?}"
        );
    }
}
