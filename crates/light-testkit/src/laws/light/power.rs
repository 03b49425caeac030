use light_math::glam::Vec2;
use light_sources::{ColorModel, Light, Radiance};

use super::LightCase;
use super::case::le;
use crate::Rng;

/// Relative error that a power may have.
const EXACT: f64 = 1e-4;

/// Absolute error that the quadrature may have where a light of about unit size is nearly dark.
const DARK: f64 = 1e-7;

/// Rows and columns of cells, each with one sample.
const CELLS: u16 = 1024;

/// `phi` is the integral of what leaves the light, to one part in ten thousand: by a million rays
/// whose first numbers are spread evenly over the unit square, so that their mean is a quadrature.
///
/// # Panics
/// If the law does not hold.
pub fn phi_is_exact<C: ColorModel, L: Light<C>>(case: &LightCase<'_, C, L>) {
    let phi = f64::from(case.light.phi(&case.wavelengths).average());
    let mut rng = Rng::new(48);
    let mut sum = 0.0;
    for y in 0..CELLS {
        for x in 0..CELLS {
            let u = (Vec2::new(x.into(), y.into()) + rng.vec2()) / f32::from(CELLS);
            sum += le(case, u, rng.vec2()).power;
        }
    }
    let mean = sum / f64::from(CELLS).powi(2);
    assert!(
        (mean - phi).abs() <= EXACT * phi + DARK,
        "{}: phi is {phi}, what leaves {mean}, off by {:e}",
        case.name,
        mean / phi - 1.0
    );
}
