/// Mean, median, a high quantile, and the standard error of the mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Summary {
    /// Mean.
    pub(super) mean: f64,
    /// Median.
    pub(super) median: f64,
    /// 99th percentile.
    pub(super) p99: f64,
    /// Standard error of the mean.
    pub(super) standard_error: f64,
}

impl Summary {
    /// The summary of `values`; NaN throughout if there are none.
    pub(super) fn new(mut values: Vec<f64>) -> Self {
        if values.is_empty() {
            return Self {
                mean: f64::NAN,
                median: f64::NAN,
                p99: f64::NAN,
                standard_error: f64::NAN,
            };
        }
        values.sort_by(f64::total_cmp);
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
        Self {
            mean,
            median: values[values.len() / 2],
            p99: values[(values.len() * 99 / 100).min(values.len() - 1)],
            standard_error: (squares / n / n).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_range() {
        let s = Summary::new((0..=100).rev().map(f64::from).collect());
        assert_eq!((s.mean, s.median, s.p99), (50.0, 50.0, 99.0), "0 to 100");
        let none = Summary::new(vec![]);
        assert!(
            none.mean.is_nan() && none.p99.is_nan(),
            "no value: {none:?}"
        );
    }
}
