use glam::{Mat3, Vec3};

use super::uplift::{Uplift, color, face};
use super::{RgbColorSpace, SigmoidPolynomial, Spectrum, cie};
use crate::float::sqrt;

/// Nodes at 360, 365, ... 830 nm, padded with one of no weight to a multiple of [`LANES`].
const NODES: usize = 96;
const LANES: usize = 8;

/// Steps after which a colour counts as solved as well as it can be.
const MAX_STEPS: usize = 40;

/// Squared distance in RGB that is as good as none.
const SOLVED: f32 = 1e-11;

/// Coefficients beyond which nothing is gained: the sigmoid is a step of a few nanometres.
const MAX_LENGTH: f32 = 200.0;

/// Finds the smooth spectrum of a colour by damped Newton steps; exact, and without a table.
///
/// A colour of sRGB takes four or five steps from grey, about two microseconds. Colours come back
/// within 5e-5 of their largest component in sRGB and within 5e-4 in Display P3; in Rec. 2020,
/// whose primaries are monochromatic lights, within 5e-2 around those and 1e-3 in the mean. In
/// ACES2065-1, whose primaries are no colours at all, what cannot be met is approached.
///
/// # Source
/// `[Jakob2019]`, section 4, by a solver of ours: Levenberg-Marquardt in linear RGB.
#[derive(Clone, Debug)]
pub struct UpliftSolver {
    /// How much each node counts in red, green and blue under the illuminant.
    weights: [[f32; NODES]; 3],
}

impl UpliftSolver {
    /// The solver for a colour space. Costs an integral over the wavelengths, a few microseconds.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "rounds to single precision"
    )]
    pub fn new(space: &RgbColorSpace) -> Self {
        let illuminant = space.illuminant();
        let mut weights = [[0.0; NODES]; 3];
        for (i, observer) in cie::OBSERVER.iter().enumerate() {
            let light = illuminant.eval(cie::LAMBDA_MIN + i as f32) / cie::Y_INTEGRAL;
            let rgb = space.rgb_from_xyz() * (*observer * light);
            // Smooth spectra are cubics between nodes, so each nanometre counts for the four around
            // it.
            let shares = cie::cubic((i % 5) as f64 * 0.2);
            for (k, share) in shares.iter().enumerate() {
                let node = (i / 5 + k).saturating_sub(1).min(NODES - 2);
                for channel in 0..3 {
                    weights[channel][node] += *share as f32 * rgb[channel];
                }
            }
        }
        Self { weights }
    }

    /// The RGB of a spectrum under the colour space's illuminant.
    #[must_use]
    pub fn rgb(&self, shape: &SigmoidPolynomial) -> Vec3 {
        self.linearize(Vec3::from_array(shape.c)).rgb
    }

    /// RGB at the coefficients `c`, and how it changes with them.
    fn linearize(&self, c: Vec3) -> Linearization {
        // Sums in lanes: the compiler makes vectors of them.
        let mut rgb = [[0.0; LANES]; 3];
        let mut moments = [[[0.0; LANES]; 3]; 3];
        for block in 0..NODES / LANES {
            for lane in 0..LANES {
                let node = block * LANES + lane;
                let x = node_position(node);
                let y = (c.z * x + c.y) * x + c.x;
                let inv = 1.0 / sqrt(1.0 + y * y);
                let value = 0.5 + 0.5 * y * inv;
                let slope = 0.5 * inv * inv * inv;
                for channel in 0..3 {
                    let weight = self.weights[channel][node];
                    rgb[channel][lane] += weight * value;
                    moments[0][channel][lane] += weight * slope;
                    moments[1][channel][lane] += weight * slope * x;
                    moments[2][channel][lane] += weight * slope * x * x;
                }
            }
        }
        let total = |v: [[f32; LANES]; 3]| Vec3::from_array(v.map(|lanes| lanes.iter().sum()));
        Linearization {
            rgb: total(rgb),
            jacobian: Mat3::from_cols(total(moments[0]), total(moments[1]), total(moments[2])),
        }
    }

    fn solve(&self, target: Vec3) -> SigmoidPolynomial {
        let mut c = Vec3::ZERO;
        let mut here = self.linearize(c);
        let mut error = here.rgb.distance_squared(target);
        let mut damping = 1e-3;
        for _ in 0..MAX_STEPS {
            if error < SOLVED || damping > 1e7 {
                break;
            }
            let next = c - here.damped_step(target, damping);
            // NaN fails this guard: the equations were singular.
            if !(next.length_squared() < MAX_LENGTH * MAX_LENGTH) {
                damping *= 8.0;
                continue;
            }
            let there = self.linearize(next);
            let next_error = there.rgb.distance_squared(target);
            if next_error < error {
                (c, here, error) = (next, there, next_error);
                damping = (0.1 * damping).max(1e-7);
            } else {
                damping *= 8.0;
            }
        }
        SigmoidPolynomial { c: c.to_array() }
    }
}

impl Uplift for UpliftSolver {
    fn shape(&self, rgb: Vec3) -> SigmoidPolynomial {
        match face(rgb) {
            // Grey is exactly constant, not up to the solver's tolerance.
            None | Some((_, 1.0, 1.0)) => SigmoidPolynomial::default(),
            Some((f, x, y)) => self.solve(color(f, x, y)),
        }
    }
}

/// A colour and its derivatives with respect to the coefficients, in columns.
struct Linearization {
    rgb: Vec3,
    jacobian: Mat3,
}

impl Linearization {
    /// What to subtract to get nearer to `target`, by the normal equations with their diagonal
    /// enlarged.
    fn damped_step(&self, target: Vec3, damping: f32) -> Vec3 {
        let transposed = self.jacobian.transpose();
        let normal = transposed * self.jacobian;
        let diagonal = Vec3::new(normal.x_axis.x, normal.y_axis.y, normal.z_axis.z);
        let damped = normal + Mat3::from_diagonal(diagonal * damping + 1e-12);
        damped.inverse() * (transposed * (self.rgb - target))
    }
}

/// Where a node lies on `[-1, 1]`, the variable of [`SigmoidPolynomial`].
#[inline]
fn node_position(node: usize) -> f32 {
    node as f32 * (2.0 / 94.0) - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The RGB of a shape by the integral over every nanometre, not by the solver's nodes.
    fn integrated_rgb(space: &RgbColorSpace, shape: &SigmoidPolynomial) -> Vec3 {
        struct Lit<'a>(&'a SigmoidPolynomial, crate::spectrum::Daylight);
        impl Spectrum for Lit<'_> {
            fn eval(&self, lambda: f32) -> f32 {
                self.0.eval(lambda) * self.1.eval(lambda)
            }
            fn max_value(&self) -> f32 {
                self.0.max_value() * self.1.max_value()
            }
        }
        space.rgb_from_xyz() * cie::xyz(&Lit(shape, space.illuminant()))
    }

    /// The largest error over a grid of colours, as a fraction of their largest component, and the
    /// mean.
    fn errors(space: &RgbColorSpace) -> (f32, f32) {
        let solver = UpliftSolver::new(space);
        let steps = 8;
        let (mut worst, mut sum, mut count) = (0.0f32, 0.0, 0.0);
        for f in 0..3 {
            for i in 0..=steps {
                for j in 0..=steps {
                    let target = color(f, i as f32 / steps as f32, j as f32 / steps as f32);
                    let rgb = integrated_rgb(space, &solver.shape(target));
                    let error = 2.0 * rgb.distance(target);
                    worst = worst.max(error);
                    sum += error;
                    count += 1.0;
                }
            }
        }
        (worst, sum / count)
    }

    #[test]
    fn colours_come_back() {
        for (space, worst_allowed, mean_allowed) in [
            (RgbColorSpace::srgb(), 5e-5, 1e-5),
            (RgbColorSpace::dci_p3(), 5e-4, 1e-5),
            (RgbColorSpace::rec2020(), 5e-2, 1e-3),
            (RgbColorSpace::aces2065_1(), 0.25, 3e-2),
        ] {
            let (worst, mean) = errors(&space);
            assert!(
                worst < worst_allowed && mean < mean_allowed,
                "worst {worst}, mean {mean} of {space:?}"
            );
        }
    }

    #[test]
    fn strength_does_not_matter() {
        let solver = UpliftSolver::new(&RgbColorSpace::srgb());
        let rgb = Vec3::new(0.25, 0.5, 0.125);
        for factor in [1e-20, 2.0, 1e20] {
            assert_eq!(solver.shape(rgb * factor), solver.shape(rgb), "{factor}");
        }
    }

    #[test]
    fn grey_and_black_are_constant() {
        let solver = UpliftSolver::new(&RgbColorSpace::aces2065_1());
        for rgb in [Vec3::splat(7.0), Vec3::ZERO, Vec3::NAN] {
            assert_eq!(solver.shape(rgb), SigmoidPolynomial::default(), "{rgb}");
        }
    }
}
