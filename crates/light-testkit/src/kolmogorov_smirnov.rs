use crate::{SIGNIFICANCE, significance};

/// What the test of Kolmogorov and Smirnov says about a set of numbers.
#[derive(Clone, Copy, Debug)]
pub struct KolmogorovSmirnov {
    /// Largest distance between the empirical and the assumed distribution function.
    pub distance: f64,
    /// The chance of a distance this large when the assumption holds.
    pub p_value: f64,
}

impl KolmogorovSmirnov {
    /// Whether the numbers pass at [`SIGNIFICANCE`].
    #[must_use]
    pub fn passes(&self) -> bool {
        self.p_value >= SIGNIFICANCE
    }
}

/// Compares independent numbers with the uniform distribution on `[0, 1)`; sorts them. A number
/// outside fails.
///
/// # Source
/// `[Stephens1970]`: the correction that makes the limiting distribution accurate for few numbers.
#[must_use]
pub fn kolmogorov_smirnov_uniform(numbers: &mut [f64]) -> KolmogorovSmirnov {
    significance::take();
    if !numbers.iter().all(|u| (0.0..1.0).contains(u)) {
        return KolmogorovSmirnov {
            distance: 1.0,
            p_value: 0.0,
        };
    }
    numbers.sort_by(f64::total_cmp);
    let n = numbers.len() as f64;
    let distance = numbers.iter().enumerate().fold(0.0, |d: f64, (i, &u)| {
        d.max(u - i as f64 / n).max((i + 1) as f64 / n - u)
    });
    let root = n.sqrt();
    KolmogorovSmirnov {
        distance,
        p_value: survival((root + 0.12 + 0.11 / root) * distance),
    }
}

/// The chance that the limiting distance exceeds `x`: `2 sum of (-1)^(k-1) exp(-2 k^2 x^2)`.
fn survival(x: f64) -> f64 {
    // Below, the sum converges slowly and the chance is one to ten digits.
    if x < 0.2 {
        return 1.0;
    }
    let term = |k: i32| (-2.0 * f64::from(k * k) * x * x).exp();
    let sum: f64 = (1..100)
        .map(|k| if k % 2 == 1 { term(k) } else { -term(k) })
        .sum();
    (2.0 * sum).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    #[test]
    fn critical_values() {
        assert!((survival(1.3581) - 0.05).abs() < 1e-4, "five per cent");
        assert!((survival(1.9495) - 0.001).abs() < 1e-5, "one in a thousand");
    }

    #[test]
    fn uniform_numbers_pass_and_others_fail() {
        let mut rng = Rng::new(2);
        let mut uniform: Vec<f64> = (0..1 << 15).map(|_| rng.f64()).collect();
        assert!(kolmogorov_smirnov_uniform(&mut uniform).passes(), "uniform");
        let mut bent: Vec<f64> = uniform.iter().map(|u| u * (0.9 + 0.1 * u)).collect();
        assert!(!kolmogorov_smirnov_uniform(&mut bent).passes(), "bent");
        let mut outside = [0.5, 1.0];
        assert!(
            !kolmogorov_smirnov_uniform(&mut outside).passes(),
            "1 is outside"
        );
    }
}
