use super::visible_range::{LAMBDA_MAX, LAMBDA_MIN};
use crate::float::{exp, ln};

/// The `N` wavelengths that a path carries, with the density of each.
///
/// The first may decide the direction of the path; the others are carried along until
/// [`terminate_secondary`](Self::terminate_secondary).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledWavelengths<const N: usize> {
    lambda: [f32; N],
    pdf: [f32; N],
}

impl<const N: usize> SampledWavelengths<N> {
    /// `N` wavelengths at equal distances over the whole range, the first by `u` in `[0, 1)`, the
    /// others around the circle.
    #[must_use]
    pub fn uniform(u: f32) -> Self {
        let range = LAMBDA_MAX - LAMBDA_MIN;
        Self {
            lambda: spread(u).map(|u| LAMBDA_MIN + u * range),
            pdf: [1.0 / range; N],
        }
    }

    /// `N` wavelengths about as often as the eye responds to them, stratified by `u` in `[0, 1)`.
    ///
    /// # Source
    /// `[PBRT4]`, section 4.5.4: density `0.0039398042 / cosh^2(0.0072 (lambda - 538))`.
    #[must_use]
    pub fn visible(u: f32) -> Self {
        let lambda = spread(u).map(sample_visible);
        Self {
            lambda,
            pdf: lambda.map(visible_pdf),
        }
    }

    /// The given wavelengths in nm, as if drawn uniformly: for tests, and for renderers with bins
    /// of their own.
    #[must_use]
    pub const fn from_lambda(lambda: [f32; N]) -> Self {
        Self {
            lambda,
            pdf: [1.0 / (LAMBDA_MAX - LAMBDA_MIN); N],
        }
    }

    /// The wavelengths in nm.
    #[inline]
    #[must_use]
    pub const fn lambda(&self) -> &[f32; N] {
        &self.lambda
    }

    /// The density of each wavelength per nm; 0 for a terminated one.
    #[inline]
    #[must_use]
    pub const fn pdf(&self) -> &[f32; N] {
        &self.pdf
    }

    /// The same wavelengths with all but the first given up, for a path that the first one alone
    /// can follow.
    ///
    /// The first one's density is divided by `N`, because estimates average over `N`. Idempotent.
    #[must_use]
    pub fn terminate_secondary(self) -> Self {
        if self.is_secondary_terminated() {
            return self;
        }
        let mut pdf = [0.0; N];
        if let (Some(first), Some(&p)) = (pdf.first_mut(), self.pdf.first()) {
            *first = p / N as f32;
        }
        Self { pdf, ..self }
    }

    /// Whether only the first wavelength is left.
    #[must_use]
    pub fn is_secondary_terminated(&self) -> bool {
        self.pdf.iter().skip(1).all(|&p| p == 0.0)
    }
}

/// `N` points of `[0, 1)` at distances of `1 / N` around the circle, the first at `u`.
fn spread<const N: usize>(u: f32) -> [f32; N] {
    core::array::from_fn(|i| {
        let u = u + i as f32 / N as f32;
        if u >= 1.0 { u - 1.0 } else { u }
    })
}

fn sample_visible(u: f32) -> f32 {
    let x = 0.856_910_62 - 1.827_501_97 * u;
    // The inverse hyperbolic tangent of x.
    let atanh = 0.5 * ln((1.0 + x) / (1.0 - x));
    (538.0 - 138.888_889 * atanh).clamp(LAMBDA_MIN, LAMBDA_MAX)
}

fn visible_pdf(lambda: f32) -> f32 {
    let e = exp(0.0072 * (lambda - 538.0));
    let cosh = 0.5 * (e + 1.0 / e);
    0.003_939_804_2 / (cosh * cosh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniform_covers_the_range_in_equal_steps() {
        let w = SampledWavelengths::<4>::uniform(0.5);
        assert_eq!(
            w.lambda(),
            &[595.0, 712.5, 360.0, 477.5],
            "around the circle"
        );
        assert_eq!(w.pdf(), &[1.0 / 470.0; 4], "density");
    }

    #[test]
    fn visible_stays_in_range_and_its_density_integrates_to_one() {
        for u in [0.0, 0.25, 0.5, crate::float::ONE_MINUS_EPSILON] {
            let w = SampledWavelengths::<4>::visible(u);
            assert!(
                w.lambda()
                    .iter()
                    .all(|l| (LAMBDA_MIN..=LAMBDA_MAX).contains(l)),
                "in range: {w:?}"
            );
        }
        let integral: f32 = (0..4700)
            .map(|i| 0.1 * visible_pdf(360.05 + 0.1 * i as f32))
            .sum();
        assert!((integral - 1.0).abs() < 1e-4, "integral {integral}");
    }

    #[test]
    fn visible_follows_its_density() {
        // The share of samples below a wavelength is the integral of the density up to it.
        let n = 10_000;
        for limit in [420.0f32, 500.0, 560.0, 700.0] {
            let share = (0..n)
                .filter(|&i| sample_visible((i as f32 + 0.5) / n as f32) < limit)
                .count() as f32
                / n as f32;
            let steps = 2000;
            let width = (limit - LAMBDA_MIN) / steps as f32;
            let integral: f32 = (0..steps)
                .map(|i| width * visible_pdf(LAMBDA_MIN + (i as f32 + 0.5) * width))
                .sum();
            assert!(
                (share - integral).abs() < 5e-4,
                "{share} below {limit}, {integral}"
            );
        }
    }

    #[test]
    fn termination_leaves_the_first_and_its_mean() {
        let w = SampledWavelengths::<4>::uniform(0.1);
        assert!(!w.is_secondary_terminated(), "all four");
        let t = w.terminate_secondary();
        assert!(t.is_secondary_terminated(), "only one");
        assert_eq!(t.pdf(), &[0.25 / 470.0, 0.0, 0.0, 0.0], "densities");
        assert_eq!(t.terminate_secondary(), t, "idempotent");
    }
}
