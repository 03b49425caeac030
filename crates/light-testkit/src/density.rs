use light_math::glam::{Vec2, Vec3};

use crate::{Cap, ChiSquared, Rng, chi_squared, integrate};

/// A density against its sampler: chi-squared on a grid of cells whose masses come from quadrature.
///
/// The sampler maps random numbers to a point, or to `None`. The density is a function of a point
/// of the domain, per unit of its measure, not normalised by the probability of `None`.
#[derive(Clone, Copy, Debug)]
pub struct DensityTest {
    /// How many samples are drawn.
    pub samples: u32,
    /// Cells along each axis.
    pub grid: [u16; 2],
    /// Seed of the random numbers.
    pub seed: u64,
    /// Absolute error of the quadrature in each cell, in units of probability: far less than the
    /// counts can show.
    pub tolerance: f64,
}

impl Default for DensityTest {
    fn default() -> Self {
        Self {
            samples: 1 << 15,
            grid: [12, 12],
            seed: 1,
            tolerance: 3e-5,
        }
    }
}

/// The result of a [`DensityTest`].
#[derive(Clone, Copy, Debug)]
pub struct DensityOutcome {
    /// The integral of the density over the domain.
    pub mass: f64,
    /// The fraction of samples that were `None`.
    pub declined: f64,
    /// Samples at which the density is not a positive finite number.
    pub impossible: u32,
    /// Samples outside of the domain (or NaN).
    pub outside: u32,
    /// The comparison of counts, with one more cell for `None`.
    pub chi_squared: ChiSquared,
}

impl DensityTest {
    /// Checks a density over `[low, high]`.
    pub fn interval(
        &self,
        [low, high]: [f32; 2],
        mut sample: impl FnMut(&mut Rng) -> Option<f32>,
        mut pdf: impl FnMut(f32) -> f32,
    ) -> DensityOutcome {
        let width = f64::from(high) - f64::from(low);
        let place = |x: f64| (f64::from(low) + x * width) as f32;
        // The second axis of the square is not used: one row of cells.
        let cells = usize::from(self.grid[0]) * usize::from(self.grid[1]);
        let edges = |i: usize| [i as f64 / cells as f64, (i + 1) as f64 / cells as f64];
        let masses = (0..cells)
            .map(|i| {
                let [a, b] = edges(i);
                let share = self.tolerance / cells as f64;
                integrate([a], [b], share, |[x]| width * f64::from(pdf(place(x))))
            })
            .collect();
        self.count(masses, |rng| {
            sample(rng).map(|x| {
                let cell = unit_cell((f64::from(x) - f64::from(low)) / width, cells);
                (cell, pdf(x))
            })
        })
    }

    /// Checks a density over the rectangle from `low` to `high`, per unit of area.
    pub fn rectangle(
        &self,
        [low, high]: [Vec2; 2],
        mut sample: impl FnMut(&mut Rng) -> Option<Vec2>,
        mut pdf: impl FnMut(Vec2) -> f32,
    ) -> DensityOutcome {
        let size = (high - low).to_array().map(f64::from);
        let place = |[x, y]: [f64; 2]| low + Vec2::new((x * size[0]) as f32, (y * size[1]) as f32);
        let area = size[0] * size[1];
        let masses = self.masses(|x| area * f64::from(pdf(place(x))));
        self.count(masses, |rng| {
            sample(rng).map(|p| {
                let [x, y] = (p - low).to_array().map(f64::from);
                (self.cell([x / size[0], y / size[1]]), pdf(p))
            })
        })
    }

    /// Checks a density over the unit square.
    pub fn square(
        &self,
        sample: impl FnMut(&mut Rng) -> Option<Vec2>,
        pdf: impl FnMut(Vec2) -> f32,
    ) -> DensityOutcome {
        self.rectangle([Vec2::ZERO, Vec2::ONE], sample, pdf)
    }

    /// Checks a density per solid angle over a cap that holds all of it.
    pub fn cap(
        &self,
        cap: &Cap,
        mut sample: impl FnMut(&mut Rng) -> Option<Vec3>,
        mut pdf: impl FnMut(Vec3) -> f32,
    ) -> DensityOutcome {
        let omega = cap.solid_angle();
        let masses = self.masses(|x| omega * f64::from(pdf(cap.direction(x))));
        self.count(masses, |rng| {
            sample(rng).map(|w| (self.cell(cap.square(w)), pdf(w)))
        })
    }

    /// Checks a density per solid angle over the whole sphere.
    pub fn sphere(
        &self,
        sample: impl FnMut(&mut Rng) -> Option<Vec3>,
        pdf: impl FnMut(Vec3) -> f32,
    ) -> DensityOutcome {
        self.cap(&Cap::sphere(), sample, pdf)
    }

    /// The mass of each cell, row by row.
    fn masses(&self, mut density: impl FnMut([f64; 2]) -> f64) -> Vec<f64> {
        let [columns, rows] = self.grid.map(usize::from);
        let (dx, dy) = (1.0 / columns as f64, 1.0 / rows as f64);
        (0..columns * rows)
            .map(|cell| {
                let low = [(cell % columns) as f64 * dx, (cell / columns) as f64 * dy];
                integrate(
                    low,
                    [low[0] + dx, low[1] + dy],
                    self.tolerance,
                    &mut density,
                )
            })
            .collect()
    }

    fn cell(&self, [x, y]: [f64; 2]) -> Option<usize> {
        let [columns, rows] = self.grid.map(usize::from);
        Some(unit_cell(y, rows)? * columns + unit_cell(x, columns)?)
    }

    /// Draws the samples; `draw` returns the cell (`None`: outside of the domain) and the density.
    fn count(
        &self,
        masses: Vec<f64>,
        mut draw: impl FnMut(&mut Rng) -> Option<(Option<usize>, f32)>,
    ) -> DensityOutcome {
        let mut rng = Rng::new(self.seed);
        let mut observed = vec![0u64; masses.len() + 1];
        let (mut declined, mut impossible, mut outside) = (0u64, 0, 0);
        for _ in 0..self.samples {
            let Some((cell, pdf)) = draw(&mut rng) else {
                declined += 1;
                continue;
            };
            impossible += u32::from(!(pdf > 0.0 && pdf.is_finite()));
            match cell {
                Some(cell) => observed[cell] += 1,
                None => outside += 1,
            }
        }
        observed[masses.len()] = declined;

        let n = f64::from(self.samples);
        let mass: f64 = masses.iter().sum();
        let mut expected: Vec<f64> = masses.iter().map(|m| m * n).collect();
        expected.push((1.0 - mass).max(0.0) * n);
        DensityOutcome {
            mass,
            declined: declined as f64 / n,
            impossible,
            outside,
            chi_squared: chi_squared(&observed, &expected),
        }
    }
}

impl DensityOutcome {
    /// How far the integral of a density may lie above one: rounding of `f32` densities and the
    /// quadrature's error.
    pub const MASS_TOLERANCE: f64 = 1e-3;

    /// The reason why the test fails; `None` if it passes.
    #[must_use]
    pub fn fault(&self) -> Option<&'static str> {
        if !(self.mass <= 1.0 + Self::MASS_TOLERANCE) {
            Some("the density integrates to more than one")
        } else if self.impossible > 0 {
            Some("a sample has no positive finite density")
        } else if self.outside > 0 {
            Some("a sample lies outside of the domain")
        } else if !self.chi_squared.passes() {
            Some("the samples do not follow the density")
        } else {
            None
        }
    }

    /// Asserts that there is no [`fault`](Self::fault).
    ///
    /// # Panics
    /// With `what`, the fault and the figures.
    pub fn assert(&self, what: &str) {
        let fault = self.fault();
        assert!(fault.is_none(), "{what}: {}: {self:?}", fault.unwrap_or(""));
    }
}

/// Which of `n` equal cells of `[0, 1]` holds `x`, with a grain of rounding at both ends.
fn unit_cell(x: f64, n: usize) -> Option<usize> {
    const ROUNDING: f64 = 1e-5;
    let inside = (-ROUNDING..=1.0 + ROUNDING).contains(&x);
    inside.then(|| ((x.max(0.0) * n as f64) as usize).min(n - 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f32::consts::PI;

    fn cosine_sample(rng: &mut Rng) -> Option<Vec3> {
        let (r, phi) = (rng.f32().sqrt(), 2.0 * PI * rng.f32());
        Some(Vec3::new(
            r * phi.cos(),
            r * phi.sin(),
            (1.0 - r * r).max(1e-12).sqrt(),
        ))
    }

    #[test]
    fn right_densities_pass() {
        let test = DensityTest::default();
        test.interval(
            [0.0, 2.0],
            |rng| Some(2.0 * rng.f32().sqrt()),
            |x| 0.5 * x.max(1e-9),
        )
        .assert("linear");
        test.square(|rng| Some(rng.vec2()), |_| 1.0)
            .assert("uniform");
        test.sphere(|rng| Some(rng.direction()), |_| 0.25 / PI)
            .assert("sphere");
        test.sphere(cosine_sample, |w| w.z.max(0.0) / PI)
            .assert("cosine over the sphere");
        test.cap(&Cap::hemisphere(Vec3::Z), cosine_sample, |w| {
            w.z.max(0.0) / PI
        })
        .assert("cosine over the hemisphere");
    }

    #[test]
    fn declined_samples_are_missing_mass() {
        let sample = |rng: &mut Rng| (rng.f32() < 0.5).then(|| rng.vec2());
        let test = DensityTest::default();
        test.square(sample, |_| 0.5).assert("half of the mass");
        let outcome = test.square(sample, |_| 1.0);
        assert!(outcome.fault().is_some(), "{outcome:?}");
    }

    #[test]
    fn each_fault_is_found() {
        let test = DensityTest::default();
        let wrong = test.sphere(cosine_sample, |w| if w.z > 0.0 { 0.5 / PI } else { 0.0 });
        assert_eq!(
            wrong.fault(),
            Some("the samples do not follow the density"),
            "shape"
        );
        let heavy = test.square(|rng| Some(rng.vec2()), |_| 1.01);
        assert_eq!(
            heavy.fault(),
            Some("the density integrates to more than one"),
            "mass"
        );
        let zero = test.square(
            |rng| Some(rng.vec2()),
            |p| if p.x < 0.5 { 2.0 } else { 0.0 },
        );
        assert_eq!(
            zero.fault(),
            Some("a sample has no positive finite density"),
            "zero"
        );
        let outside = test.square(|rng| Some(rng.vec2() * 2.0), |_| 1.0);
        assert_eq!(
            outside.fault(),
            Some("a sample lies outside of the domain"),
            "outside"
        );
    }
}
