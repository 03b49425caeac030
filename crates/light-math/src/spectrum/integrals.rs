use glam::Vec3;

use super::observer::{OBSERVER, SAMPLES};
use super::visible_range::LAMBDA_MIN;

/// The luminous efficacy of a monochromatic light of 555 nm, in lm/W.
pub const K_M: f32 = 683.0;

/// The integrals of a spectral quantity per nm over the wavelengths from 360 to 830 nm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpectrumIntegrals {
    /// In photometric units: W/nm to lm, W/(sr nm) to cd, and so on.
    pub luminous: f32,
    /// In radiometric units: W/nm to W, and so on.
    pub radiant: f32,
    /// With each of the [colour matching functions](super::cie::matching).
    pub xyz: Vec3,
}

impl SpectrumIntegrals {
    /// The sum of the trapezoids between whole nanometres.
    pub(super) fn of_nanometres(eval: impl Fn(f32) -> f32) -> Self {
        let mut sum = Self::default();
        for (i, observer) in OBSERVER.iter().enumerate() {
            let full = eval(LAMBDA_MIN + i as f32);
            // The sum of all rows, by which the constant spectrum 1 is exact in any scale.
            sum.xyz += *observer * full;
            let width = if i == 0 || i == SAMPLES - 1 { 0.5 } else { 1.0 };
            let value = width * full;
            sum.luminous += value * observer.y;
            sum.radiant += value;
        }
        sum.luminous *= K_M;
        sum
    }

    /// Adds the part from `lambda[0]` to `lambda[1]`, which lie in the range and have no whole
    /// nanometre between them, of a spectrum that is straight there, with a value at either end.
    /// The matching functions are straight between whole nanometres, so that nothing is missed.
    pub(super) fn add_straight(&mut self, lambda: [f32; 2], value: [f32; 2]) {
        let step = lambda[1] - lambda[0];
        let i = whole_nanometre(lambda[0]);
        let [below, above] = [OBSERVER[i], OBSERVER[i + 1]];
        let [a, b] = lambda.map(|lambda| {
            let t = lambda - LAMBDA_MIN - i as f32;
            below * (1.0 - t) + above * t
        });
        let product = (2.0 * a + b) * value[0] + (a + 2.0 * b) * value[1];
        self.xyz += product * (step / 6.0);
        self.luminous += K_M / 6.0 * step * product.y;
        self.radiant += 0.5 * step * (value[0] + value[1]);
    }
}

/// The nanometre of the table at or below `lambda`, which is not the last one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between 0 and 469"
)]
fn whole_nanometre(lambda: f32) -> usize {
    ((lambda - LAMBDA_MIN).max(0.0) as usize).min(SAMPLES - 2)
}
